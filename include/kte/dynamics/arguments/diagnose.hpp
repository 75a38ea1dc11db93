#pragma once

#include <kte/errors.hpp>
#include <kte/kernels/joint_vector.hpp>
#include <kte/kernels/solve.hpp>
#include <kte/static_chain/layout.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

/// Finds the argument that made a result non-finite. Finite results do not pass through this code.
namespace kte::detail {

/// A vector of arguments: 'q', or 'v', 'a', 'tau', which share a layout.
struct argument {
  const char* name;
  std::span<const double> numbers;
  bool configuration = false;
};

/// "v[2] of 'elbow' is 1e+160"
template <class Layout>
std::string describe_number(const Layout& layout, const argument& x, std::size_t i) {
  // Operator + causes spurious warnings of g++ 12 at -O3.
  std::string text(x.name);
  text.append("[").append(std::to_string(i)).append("]");
  for (const auto& e : layout) {
    const auto first = static_cast<std::size_t>(x.configuration ? e.q : e.v);
    const auto count = static_cast<std::size_t>(x.configuration ? e.nq : e.nv);
    if (i >= first && i < first + count) text.append(" of '").append(e.name).append("'");
  }
  return text.append(" is ").append(number(x.numbers[i]));
}
/// The first number that is not finite, otherwise the largest number if its square overflows; empty if there is
/// neither.
template <class Layout>
std::string culprit(const Layout& layout, std::initializer_list<argument> arguments) {
  const argument* where = nullptr;
  std::size_t which = 0;
  double largest = 1e150;
  for (const auto& x : arguments)
    for (std::size_t i = 0; i < x.numbers.size(); ++i) {
      const double size = std::fabs(x.numbers[i]);
      if (!std::isfinite(size)) return describe_number(layout, x, i);
      if (size > largest) where = &x, which = i, largest = size;
    }
  return where ? describe_number(layout, *where, which) + ", too large" : "";
}
template <class Layout>
[[noreturn, gnu::cold]] void raise_not_finite(const char* what, const Layout& layout,
                                              std::initializer_list<argument> arguments) {
  const auto which = culprit(layout, arguments);
  raise<bad_argument>("kte: " + std::string(what) + " is not finite: " +
                      (which.empty() ? "a parameter or an argument is not finite, or is too large" : which));
}
/// Names the coordinate whose quaternion has length 0, if there is one.
template <class Layout>
[[gnu::cold]] void raise_if_no_rotation(const Layout& layout, std::span<const double> q) {
  for (const auto& e : layout) {
    if (e.what != kind::rotation_3D && e.what != kind::pose_3D) continue;
    const auto r = static_cast<std::size_t>(e.q + e.nq - 4);
    if (q[r] == 0 && q[r + 1] == 0 && q[r + 2] == 0 && q[r + 3] == 0)
      raise<bad_argument>(std::string("kte: quaternion '").append(e.name).append("' has length 0"));
  }
}

/// Whether S has numbers to report: real scalars, and packs of them.
template <class S>
inline constexpr bool has_plain_numbers = std::is_convertible_v<S, double> || requires {
  S::lanes;
};
/// The number as a double; typed zeros and `skip` as 0. For a pack the first element that is not finite, else the
/// largest one.
template <class X>
double plain_number(const X& x) {
  if constexpr (std::is_same_v<X, zero_t> || std::is_same_v<X, skip>) {
    return 0;
  } else if constexpr (requires { static_cast<double>(x); }) {
    return static_cast<double>(x);
  } else if constexpr (requires { X::lanes; }) {
    double largest = 0;
    for (std::size_t i = 0; i < std::size_t{X::lanes}; ++i) {
      const auto lane = static_cast<double>(x[i]);
      if (!std::isfinite(lane)) return lane;
      if (std::fabs(lane) > std::fabs(largest)) largest = lane;
    }
    return largest;
  } else {
    return 0;  // dual numbers are not reported
  }
}
/// x[0] ... x[n-1].
template <class X>
std::vector<double> plain_numbers(const X& x, std::size_t n) {
  std::vector<double> all;
  for (std::size_t i = 0; i < n; ++i) all.push_back(plain_number(x[i]));
  return all;
}
/// Diagnoses a vector of a runtime chain.
template <class X>
std::vector<double> plain_numbers(const X& x) {
  return plain_numbers(x.data(), static_cast<std::size_t>(x.size()));
}
/// Throws `bad_argument` if the time is not finite.
template <class T>
[[gnu::cold]] void raise_if_time_is_non_finite(const char* what, const T& dt) {
  const double x = plain_number(dt);
  if (!std::isfinite(x)) raise<bad_argument>("kte: " + std::string(what) + " is not finite: dt is " + number(x));
}

/// Throws `bad_argument` for an external signal, one number or three, that is not finite.
template <class X>
[[gnu::cold]] void raise_if_signal_is_non_finite(const char* what, std::string_view name, const X& x) {
  const auto check = [&](const char* part, const auto& number_of_it) {
    const double y = plain_number(number_of_it);
    if (!std::isfinite(y))
      raise<bad_argument>(std::string("kte: ")
                              .append(what)
                              .append(" is not finite: ")
                              .append(part)
                              .append("input '")
                              .append(name)
                              .append("' is ")
                              .append(number(y)));
  };
  if constexpr (requires { x.x, x.y, x.z; }) {
    check("x of ", x.x), check("y of ", x.y), check("z of ", x.z);
  } else {
    check("", x);
  }
}

/// The name of the coordinate of row i of v.
template <class Layout>
std::string_view name_of_row(const Layout& layout, int i) {
  for (const auto& e : layout)
    if (i >= e.v && i < e.v + e.nv) return e.name;
  return {};
}
/// Diagnoses a coordinate whose mass overflows, though no argument is too large.
[[noreturn, gnu::cold]] inline void raise_non_finite_mass(std::string_view coordinate) {
  raise<bad_argument>(std::string("kte: a mass is not finite: the bodies moved by '")
                          .append(coordinate)
                          .append("' are too heavy, too far away, or infinitely fast (a loop at its dead centre)"));
}
/// Diagnoses a mass matrix without factorization, at coordinate `row`: its mass is zero, or not finite.
template <class Layout>
[[noreturn, gnu::cold]] void raise_unusable_mass(const Layout& layout, int row, bool finite,
                                                 std::span<const double> q) {
  if (finite) raise_singular_mass_matrix(name_of_row(layout, row));
  const argument positions{"q", q, true};
  if (!culprit(layout, {positions}).empty()) raise_not_finite("a mass", layout, {positions});
  raise_non_finite_mass(name_of_row(layout, row));
}
/// Diagnoses a coordinate whose load-dependent friction has no consistent accelerations.
[[noreturn, gnu::cold]] inline void raise_jammed(std::string_view coordinate) {
  raise<no_solution>(
      std::string("kte: load-dependent friction jams at '")
          .append(coordinate)
          .append("': the accelerations have no solution, or several, or lose half their digits; use a smaller "
                  "coefficient of friction or bearing radius"));
}
/// The reason if nothing else is known: the arguments are too large.
struct too_large {
  const char* what;
  [[noreturn, gnu::cold]] void operator()() const {
    raise<bad_argument>(std::string("kte: ").append(what).append(" is not finite: an argument is too large"));
  }
};
/// The first row of a matrix with a number that is not finite, column by column; otherwise -1.
template <class Matrix>
int first_non_finite(const Matrix& m) {
  const auto n = static_cast<int>(m.rows());
  for (int j = 0; j < n; ++j)
    if (!all_finite(&m(j, j), 1)) return j;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      if (!all_finite(&m(i, j), 1)) return j;
  return -1;
}

// ---- static chains

// ---- the numbers of v or a, by at<i>()

/// Numbers from an object with operator[].
template <class S, class V>
struct each {
  const V& v;
  template <int I>
  KTE_INLINE S at() const {
    return S(v[static_cast<std::size_t>(I)]);
  }
};
/// One typed constant, or `skip`, for all numbers.
template <class T>
struct same {
  template <int I>
  KTE_INLINE static constexpr T at() {
    return {};
  }
};

template <class Wiring>
struct layout_of_wiring;
template <class... E>
struct layout_of_wiring<wiring<E...>> {
  static constexpr auto table = layout_of<wiring<E...>, E...>();
};
/// The names of the external signals, from the table of the wiring.
template <class Wiring>
struct signals_of_wiring;
template <class... E>
struct signals_of_wiring<wiring<E...>> {
  static constexpr auto names = [] {
    using all = wiring<E...>;
    std::array<std::string_view, all::ports + 1> list{};
    const auto at_ports = names_at_ports<all, E...>();
    for (std::size_t i = 0; i < std::size_t{all::table.signals}; ++i)
      for (std::size_t port = all::ports; port-- > 0;)
        if (all::table.what[port] == all::table.signal[i].what && all::table.slot[port] == all::table.signal[i].slot)
          list[i] = at_ports[port];
    return list;
  }();
};
/// Throws `bad_argument`, naming the signal, if an external signal is not finite.
template <class Wiring, class Given>
[[gnu::cold, gnu::noinline]] void diagnose_signals(const char* what, const Given& g) {
  const auto one = [&]<std::size_t I>() {
    constexpr auto signal = Wiring::table.signal[I];
    if constexpr (signal.what == kind::vector) {
      raise_if_signal_is_non_finite(what, signals_of_wiring<Wiring>::names[I], g.template vector<signal.slot>());
    } else {
      raise_if_signal_is_non_finite(what, signals_of_wiring<Wiring>::names[I], g.template input<signal.slot>());
    }
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) { (one.template operator()<I>(), ...); }
  (std::make_index_sequence<std::size_t{Wiring::table.signals}>{});
}
/// The numbers at<0>(), at<1>() ... as doubles.
template <int N, class V>
std::array<double, std::size_t{N} + 1> plain_numbers(const V& v) {
  const auto plain = [](const auto& x) { return plain_number(x); };
  return [&]<int... I>(std::integer_sequence<int, I...>) {
    return std::array<double, std::size_t{N} + 1>{plain(v.template at<I>())...};
  }
  (std::make_integer_sequence<int, N>{});
}
/// Arguments by number: at<I>() as in dynamics/unrolled/given.hpp.
template <class Wiring, class Q, class V, class A>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose(const char* what, Q q, V v, A a, const char* a_name) {
  const auto x = plain_numbers<Wiring::nq>(q);
  const auto y = plain_numbers<Wiring::dofs>(v), z = plain_numbers<Wiring::dofs>(a);
  const auto& layout = layout_of_wiring<Wiring>::table;
  constexpr auto n = std::size_t{Wiring::dofs}, nq = std::size_t{Wiring::nq};
  if constexpr (requires { requires has_plain_numbers<std::remove_cvref_t<decltype(q.template at<0>())>>; })
    raise_if_no_rotation(layout, {x.data(), nq});
  raise_not_finite(what, layout, {{"q", {x.data(), nq}, true}, {"v", {y.data(), n}}, {a_name, {z.data(), n}}});
}
template <class Wiring, class Q>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_mass(int row, bool finite, Q q) {
  const auto x = plain_numbers<Wiring::nq>(q);
  raise_unusable_mass(layout_of_wiring<Wiring>::table, row, finite, {x.data(), std::size_t{Wiring::nq}});
}
template <class Wiring, class Matrix, class Q>
[[gnu::cold, gnu::noinline]] void diagnose_non_finite(const Matrix& m, Q q) {
  if (const int row = first_non_finite(m); row >= 0) diagnose_mass<Wiring>(row, false, q);
}
/// Diagnoses the bits of dynamics/unrolled/articulated.hpp, for the last row, whose joint carries no other joint.
template <class Wiring, class Q>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_axes(std::uint64_t massless, std::uint64_t non_finite, Q q) {
  const int last = static_cast<int>(std::bit_width(massless)) - 1;
  if (Wiring::dofs > 64 && last == 63) raise_singular_mass_matrix();
  diagnose_mass<Wiring>(last, (non_finite >> last & 1) == 0, q);
}
/// Diagnoses one vector of arguments, or two configurations.
template <class Wiring, class X>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_rates(const char* what, const char* name, X x) {
  const auto numbers = plain_numbers<Wiring::dofs>(x);
  raise_not_finite(what, layout_of_wiring<Wiring>::table, {{name, {numbers.data(), std::size_t{Wiring::dofs}}}});
}
template <class Wiring, class Q>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_configurations(const char* what, Q from, Q to) {
  constexpr auto n = std::size_t{Wiring::nq};
  const auto x = plain_numbers<Wiring::nq>(from), y = plain_numbers<Wiring::nq>(to);
  const auto& layout = layout_of_wiring<Wiring>::table;
  raise_if_no_rotation(layout, {x.data(), n}), raise_if_no_rotation(layout, {y.data(), n});
  raise_not_finite(what, layout, {{"from", {x.data(), n}, true}, {"to", {y.data(), n}, true}});
}

/// Throws `bad_argument` with the cause unless x[0] ... x[n-1] are finite, so that no algorithm returns NaN.
template <class X, class Diagnose>
KTE_INLINE constexpr void check_result(const X& x, std::size_t n, const Diagnose& why) {
  if (!all_finite(x, n)) [[unlikely]]
    why();
}
/// Calls `why` unless an inverse is finite: no entry exceeds the largest diagonal entry. (The same holds for a mass
/// matrix, but not for intermediate results.)
template <class Matrix, class Diagnose>
KTE_INLINE void check_inverse(const Matrix& m, const Diagnose& why) {
  using S = typename Matrix::Scalar;
  S zero_or_nan(0);
  for (Eigen::Index i = 0; i < m.rows(); ++i) zero_or_nan += m(i, i) * S(0);
  if (!all(zero_or_nan == S(0))) [[unlikely]]
    why();
}

}  // namespace kte::detail
