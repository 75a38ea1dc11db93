#pragma once

#include <kte/contract/closure.hpp>
#include <kte/errors.hpp>
#include <kte/math/dual.hpp>
#include <kte/math/out_of_line.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

/// Functions y(q) that equations define:
///
///   F(q, y) = 0,   as many rows as y has numbers          (1)
namespace kte::detail {

template <class S, std::size_t N>
using numbers = std::array<S, N>;

/// A solution y of (1), and (dF/dy)^-1 there.
template <class S, std::size_t M>
struct implicit_solution {
  numbers<S, M> y;
  numbers<numbers<S, M>, M> inverse;
};
/// Why there is none.
enum class no_solution_of {
  none,
  beyond,        ///< no solution, or none is found
  undetermined,  ///< a dead point: rates of y do not follow from those of q
  ambiguous      ///< two solutions, too near to each other
};

/// The relative error of dF/dy, and whether rates of y are bounded where it is large.
struct rate_certainty {
  double error;
  bool bounded;
};

/// f(q_1, ..., y_1, ...) as an array of M rows: of a function that returns a number, or `make_rows(...)`.
template <class T, std::size_t N, std::size_t M, class Law>
constexpr numbers<T, M> rows_of(const Law& law, const numbers<T, N>& q, const numbers<T, M>& y) {
  return [&]<std::size_t... I, std::size_t... K>(std::index_sequence<I...>, std::index_sequence<K...>) {
    const auto f = law(q[I]..., y[K]...);
    if constexpr (M == 1) {
      if constexpr (requires { nth<0>(f); })
        return numbers<T, M>{as<T>(nth<0>(f))};
      else
        return numbers<T, M>{as<T>(f)};
    } else {
      return numbers<T, M>{as<T>(nth<K>(f))...};
    }
  }
  (std::make_index_sequence<N>{}, std::make_index_sequence<M>{});
}
template <class S, std::size_t M>
constexpr numbers<S, M> product(const numbers<numbers<S, M>, M>& a, const numbers<S, M>& x) {
  numbers<S, M> y{};
  for (std::size_t i = 0; i < M; ++i)
    for (std::size_t k = 0; k < M; ++k) y[i] += a[i][k] * x[k];
  return y;
}
/// a^-1 by elimination with row pivots; false if a pivot is nothing.
template <class S, std::size_t M>
constexpr bool invert(numbers<numbers<S, M>, M> a, numbers<numbers<S, M>, M>& x) {
  using std::abs;
  x = {};
  for (std::size_t i = 0; i < M; ++i) x[i][i] = S(1);
  for (std::size_t k = 0; k < M; ++k) {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < M; ++i)
      if (abs(a[i][k]) > abs(a[p][k])) p = i;
    if (!(abs(a[p][k]) > S(0))) return false;
    std::swap(a[p], a[k]), std::swap(x[p], x[k]);
    const S pivot = S(1) / a[k][k];
    for (std::size_t c = 0; c < M; ++c) a[k][c] *= pivot, x[k][c] *= pivot;
    for (std::size_t i = 0; i < M; ++i) {
      if (i == k) continue;
      const S factor = a[i][k];
      for (std::size_t c = 0; c < M; ++c) a[i][c] -= factor * a[k][c], x[i][c] -= factor * x[k][c];
    }
  }
  return true;
}
/// The largest of numbers, each relative to that of y where that is above 1.
template <class S, std::size_t M>
constexpr S largest(const numbers<S, M>& d, const numbers<S, M>& y) {
  using std::abs;
  S most(0);
  for (std::size_t k = 0; k < M; ++k) {
    const S size = S(abs(d[k])) / (S(abs(y[k])) > S(1) ? S(abs(y[k])) : S(1));
    if (!(size <= most)) most = size;  // NaN stays
  }
  return most;
}

/// Newton's method for (1) at plain numbers q. A step that does not bring the next one down is shortened (natural
/// monotonicity: Deuflhard, Newton Methods for Nonlinear Problems, 2004, 3.3).
template <class Law, class S, std::size_t N, std::size_t M>
class newton_solver {
 public:
  using number = dual<S, static_cast<int>(M)>;
  using vector = numbers<S, M>;

  constexpr newton_solver(const Law& law, const numbers<S, N>& q) : law_(law), q_(q) {}

  /// `near`: the start is known to be on the branch that is wanted.
  constexpr no_solution_of solve(const vector& start, bool near, implicit_solution<S, M>& x) const {
    using std::sqrt;
    const S eps = std::numeric_limits<S>::epsilon(), half_digits = S(sqrt(eps));
    x.y = start;
    S before(-1), shortened(1);
    for (int step = 0; step < 60; ++step) {
      const auto [f, by_y] = at(x.y);
      if (!invert(by_y, x.inverse)) return no_solution_of::undetermined;
      const vector d = product(x.inverse, f);
      const S size = largest(d, x.y);
      if (!(size < std::numeric_limits<S>::infinity())) return no_solution_of::undetermined;
      if (near && step == 1 && size > S(1e3) * eps && size > before / S(4)) return no_solution_of::ambiguous;
      if (size <= S(4) * eps || (before >= S(0) && size < half_digits && size * S(2) > before)) {
        move(x.y, d, S(1));
        return no_solution_of::none;
      }
      S part(1);
      if (size > half_digits)
        for (part = S(shortened + shortened < S(1) ? shortened + shortened : S(1));; part /= S(2)) {
          vector y = x.y;
          move(y, d, part);
          const vector next = product(x.inverse, rows_of<S>(law_, q_, y));
          if (largest(next, y) <= (S(1) - part / S(4)) * size) break;
          if (part < S(1e-4)) return no_solution_of::beyond;
        }
      move(x.y, d, part);
      shortened = part, before = part < S(1) ? S(-1) : size;
    }
    return no_solution_of::beyond;
  }
  /// How certain derivatives of y are. F is uncertain by its rounding r, about eps times the largest of
  /// |F_q q|, |F_y y| and, as terms may cancel in these, |F_yy y y|; y is uncertain by e = |F_y^-1| r, and F_y by
  ///
  ///   F_y^-1 (d/dy F_y) e          (2)
  ///
  /// At a dead point y' = -F_y^-1 F_q q' grows beyond all limits, where branches cross it does not.
  constexpr rate_certainty rates(const implicit_solution<S, M>& x) const {
    using std::abs;
    using all = dual<S, static_cast<int>(N + M)>;
    using along = dual<S, 1>;
    using twice = dual<along, static_cast<int>(M)>;
    const S eps = std::numeric_limits<S>::epsilon();
    const auto size = [](const S& a) { return S(abs(a)) > S(1) ? S(abs(a)) : S(1); };
    numbers<all, N> q;
    numbers<all, M> y;
    numbers<twice, N> q_fixed;
    numbers<twice, M> y_moving;
    for (std::size_t i = 0; i < N; ++i)
      q[i] = all(q_[i]), q[i].derivative[i] = S(1), q_fixed[i] = twice(along(q_[i]));
    for (std::size_t k = 0; k < M; ++k) {
      y[k] = all(x.y[k]), y[k].derivative[N + k] = S(1);
      along moved(x.y[k]);
      moved.derivative[0] = size(x.y[k]);
      y_moving[k] = twice(moved), y_moving[k].derivative[k] = along(S(1));
    }
    const auto f = rows_of<all>(law_, q, y);
    const auto g = rows_of<twice>(law_, q_fixed, y_moving);
    S uncertain(0);
    for (std::size_t k = 0; k < M; ++k) {
      S e(0);
      for (std::size_t r = 0; r < M; ++r) {
        S rounding = abs(f[r].value);
        for (std::size_t i = 0; i < N; ++i) rounding += eps * S(abs(f[r].derivative[i])) * size(q_[i]);
        for (std::size_t i = 0; i < M; ++i)
          rounding += eps * size(x.y[i]) * (S(abs(f[r].derivative[N + i])) + S(abs(g[r].derivative[i].derivative[0])));
        e += S(abs(x.inverse[k][r])) * rounding;
      }
      e /= size(x.y[k]);
      if (!(e < uncertain)) uncertain = e;
    }
    S most(0);
    for (std::size_t c = 0; c < M; ++c) {
      vector change;
      for (std::size_t r = 0; r < M; ++r) change[r] = g[r].derivative[c].derivative[0];
      for (const S& part : product(x.inverse, change))
        if (!(abs(part) * uncertain <= most)) most = abs(part) * uncertain;
    }
    return {static_cast<double>(most), slope(x, f) < S(100)};
  }

 private:
  /// The largest rate of y at unit rates of q, from rows with their derivatives.
  template <class Rows>
  static constexpr S slope(const implicit_solution<S, M>& x, const Rows& f) {
    vector all{};
    for (std::size_t i = 0; i < N; ++i) {
      vector by_q;
      for (std::size_t r = 0; r < M; ++r) by_q[r] = f[r].derivative[i];
      const vector y = product(x.inverse, by_q);
      for (std::size_t k = 0; k < M; ++k) {
        using std::abs;
        all[k] += S(abs(y[k]));
      }
    }
    return largest(all, x.y);
  }
  static constexpr void move(vector& y, const vector& d, const S& part) {
    for (std::size_t k = 0; k < M; ++k) y[k] -= part * d[k];
  }
  constexpr std::pair<vector, numbers<vector, M>> at(const vector& at_y) const {
    numbers<number, N> q;
    numbers<number, M> y;
    for (std::size_t i = 0; i < N; ++i) q[i] = number(q_[i]);
    for (std::size_t k = 0; k < M; ++k) y[k] = number(at_y[k]), y[k].derivative[k] = S(1);
    const auto f = rows_of<number>(law_, q, y);
    std::pair<vector, numbers<vector, M>> x;
    for (std::size_t r = 0; r < M; ++r) {
      x.first[r] = f[r].value;
      for (std::size_t k = 0; k < M; ++k) x.second[r][k] = f[r].derivative[k];
    }
    return x;
  }
  const Law& law_;
  const numbers<S, N>& q_;
};

/// Numbers with derivatives, of other such numbers or of plain ones: `order` times. `with<L>`: with plain numbers L.
template <class T>
struct derivatives_of {
  static constexpr int order = 0;
  using plain = T;
  template <class L>
  using with = L;
  static constexpr const T& value(const T& x) { return x; }
  template <class L>
  static constexpr L to(const T& x) {
    return static_cast<L>(x);
  }
  template <class L>
  static constexpr T from(const L& x) {
    return static_cast<T>(x);
  }
};
template <class T, int N>
struct derivatives_of<dual<T, N>> {
  using inner = derivatives_of<T>;
  static constexpr int order = 1 + inner::order;
  using plain = typename inner::plain;
  template <class L>
  using with = dual<typename inner::template with<L>, N>;
  static constexpr const plain& value(const dual<T, N>& x) { return inner::value(x.value); }
  template <class L>
  static constexpr with<L> to(const dual<T, N>& x) {
    with<L> y(inner::template to<L>(x.value));
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = inner::template to<L>(x.derivative[i]);
    return y;
  }
  template <class X>
  static constexpr dual<T, N> from(const X& x) {
    dual<T, N> y(inner::from(x.value));
    for (std::size_t i = 0; i < N; ++i) y.derivative[i] = inner::from(x.derivative[i]);
    return y;
  }
};
template <class D>
struct derivatives_of<out_of_line<D>> : derivatives_of<D> {
  static constexpr const auto& value(const out_of_line<D>& x) { return derivatives_of<D>::value(x.number); }
  template <class L>
  static constexpr auto to(const out_of_line<D>& x) {
    return derivatives_of<D>::template to<L>(x.number);
  }
  template <class X>
  static constexpr out_of_line<D> from(const X& x) {
    return derivatives_of<D>::from(x);
  }
};

template <class One, class T>
constexpr One lane_of(const T& x, std::size_t lane) {
  if constexpr (is_dual<T>) {
    One y{};
    y.value = lane_of<decltype(y.value)>(x.value, lane);
    for (std::size_t i = 0; i < T::variables; ++i)
      y.derivative[i] = lane_of<decltype(y.value)>(x.derivative[i], lane);
    return y;
  } else {
    return x[lane];
  }
}
template <class T, class One>
constexpr void set_lane(T& x, std::size_t lane, const One& y) {
  if constexpr (is_dual<T>) {
    set_lane(x.value, lane, y.value);
    for (std::size_t i = 0; i < T::variables; ++i) set_lane(x.derivative[i], lane, y.derivative[i]);
  } else {
    x.set(lane, y);
  }
}
/// of(q, start) of each lane of packs.
template <class One, class T, std::size_t N, class S, std::size_t M, class F>
constexpr numbers<T, M> lane_by_lane(const numbers<T, N>& q, const numbers<S, M>& start, const F& of) {
  numbers<T, M> y{};
  for (std::size_t lane = 0; lane < S::lanes; ++lane) {
    numbers<One, N> at;
    numbers<typename S::value_type, M> from;
    for (std::size_t i = 0; i < N; ++i) at[i] = lane_of<One>(q[i], lane);
    for (std::size_t k = 0; k < M; ++k) from[k] = start[k][lane];
    const auto found = of(at, from);
    for (std::size_t k = 0; k < M; ++k) set_lane(y[k], lane, found[k]);
  }
  return y;
}
/// What is certain enough, and what is not: near a crossing of branches the error of y'' is that of dF/dy by another
/// small number. Between them more digits are taken where there are any.
inline constexpr double certain = 1e-12, uncertain = 1.5e-8;

/// y of (1) and its derivatives, to all orders of T: with J = dF/dy of plain numbers each step of
///
///   y <- y - J^-1 F(q, y)          (3)
///
/// makes the derivatives of one order more exact. fail(why, q) throws.
template <class T, std::size_t N, std::size_t M, class Law>
constexpr numbers<T, M> with_derivatives(const Law& law, const numbers<T, N>& q,
                                         const implicit_solution<typename derivatives_of<T>::plain, M>& x) {
  numbers<T, M> y;
  for (std::size_t k = 0; k < M; ++k) y[k] = T(x.y[k]);
  for (int step = 0; step < derivatives_of<T>::order; ++step) {
    const auto f = rows_of<T>(law, q, y);
    for (std::size_t k = 0; k < M; ++k)
      for (std::size_t r = 0; r < M; ++r) y[k] -= T(x.inverse[k][r]) * f[r];
  }
  return y;
}
template <class T, std::size_t N, std::size_t M, class Law, class S, class Fail>
constexpr numbers<T, M> implicit_value(const Law& law, const numbers<T, N>& q, const numbers<S, M>& start, bool near,
                                       const Fail& fail) {
  using of = derivatives_of<T>;
  if constexpr (requires { S::lanes; }) {
    using one = typename of::template with<typename S::value_type>;
    return lane_by_lane<one>(q, start, [&](const auto& at, const auto& from) {
      return implicit_value<one>(law, at, from, near, fail);
    });
  } else {
    numbers<S, N> plain;
    for (std::size_t i = 0; i < N; ++i) plain[i] = of::value(q[i]);
    implicit_solution<S, M> x;
    const newton_solver<Law, S, N, M> newton(law, plain);
    const auto require = [&](no_solution_of why) {
      if (why != no_solution_of::none) [[unlikely]]
        fail(why, plain);
    };
    require(newton.solve(start, near, x));
    if constexpr (of::order > 0) {
      const rate_certainty rates = newton.rates(x);
      if (!(rates.error <= certain)) [[unlikely]] {
        if constexpr (std::is_same_v<S, double> || std::is_same_v<S, float>) {
          using more = std::conditional_t<std::is_same_v<S, float>, double, long double>;
          using number = typename of::template with<more>;
          numbers<number, N> p;
          numbers<more, M> from;
          for (std::size_t i = 0; i < N; ++i) p[i] = of::template to<more>(q[i]);
          for (std::size_t k = 0; k < M; ++k) from[k] = x.y[k];
          const auto exact = implicit_value<number>(law, p, from, false, fail);
          numbers<T, M> y;
          for (std::size_t k = 0; k < M; ++k) y[k] = of::from(exact[k]);
          return y;
        } else if (!(rates.error < uncertain)) {
          require(rates.bounded ? no_solution_of::ambiguous : no_solution_of::undetermined);
        }
      }
    }
    return with_derivatives<T>(law, q, x);
  }
}

}  // namespace kte::detail
