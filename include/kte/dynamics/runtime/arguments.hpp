#pragma once

#include <kte/dynamics/runtime/vectors.hpp>
#include <kte/runtime_chain/chain.hpp>
#include <kte/tree/finite.hpp>

#include <tuple>
#include <type_traits>

/// Checking and storing the arguments of algorithms on runtime chains.
namespace kte::detail {

/// Calls visit(c) for generalized coordinates that base_gen declares (prescribed motion).
template <class State, class Visit>
void for_each_given_coordinate(State& s, const Visit& visit) {
  const auto& plan = s.tree().plan;
  if (plan.coordinates == s.dofs()) return;
  const auto& writers = s.made_for()->writers[static_cast<std::size_t>(kind::gen)];
  for (std::size_t i = 0; i < writers.size(); ++i)
    if (plan.row_of_gen[i] >= s.dofs() && writers[i] < 0) visit(s.template get<kind::gen>(static_cast<int>(i)));
}

/// Checks whether positions are finite and quaternions not zero.
class position_check {
 public:
  template <class S>
  void number(const S& x) {
    good_ &= all(x - x == S(0));
  }
  template <class C>
  void coordinate(const C& c) {
    visit_q(c, [this](const auto& x) { this->number(x); });
    if constexpr (requires { c.rotation; }) rotation(c.rotation.w, c.rotation.x, c.rotation.y, c.rotation.z);
  }
  /// Accepts a quaternion of any length but zero.
  template <class S>
  void rotation(const S& w, const S& x, const S& y, const S& z) {
    using std::abs;
    good_ &= all(S(S(abs(w) + abs(x)) + S(abs(y) + abs(z))) != S(0));
  }
  void finite(bool all_are) { good_ &= all_are; }
  bool good() const { return good_; }

 private:
  bool good_ = true;
};

/// Throws `bad_argument`, naming the number of one argument vector that is not finite.
template <class S, class X>
[[noreturn, gnu::cold, gnu::noinline]] void diagnose_argument(const char* what, const basic_runtime_state<S>& s,
                                                              const X& x, const char* name, int n,
                                                              bool configuration = false) {
  runtime_vector<S> numbers(n);
  for (int i = 0; i < n; ++i) numbers[i] = static_cast<S>(x[static_cast<std::size_t>(i)]);
  const auto all = plain_numbers(numbers);
  const auto layout = layout_of_state(s);
  if (configuration && has_plain_numbers<S>) raise_if_no_rotation(layout, all);
  raise_not_finite(what, layout, {{name, all, configuration}});
}

/// Checks the positions that are stored in a state.
template <class S>
void check_positions(const basic_runtime_state<S>& s) {
  position_check all;
  for_each_listed_freedom(s, [&all](const auto& c, const freedom&) { all.coordinate(c); });
  for_each_given_coordinate(s, [&all](const auto& c) { all.number(c.q); });
  if (!all.good()) [[unlikely]]
    diagnose("a coordinate", s);
}
template <class S, class X>
void check_state(const basic_runtime_state<S>& s, const X& visit, const char* what) {
  bool finite = true;
  for_each_listed_freedom(
      s, [&](const auto& c, const freedom&) { visit(c, [&](const S& x) { finite &= all(x - x == S(0)); }); });
  if (!finite) throw bad_argument(what);
}
template <class S>
void check_state_velocities(const basic_runtime_state<S>& s) {
  check_positions(s);
  check_state(
      s, [](const auto& c, const auto& f) { visit_v(c, f); }, "kte: a velocity is not finite");
}
/// Whether n numbers are finite after conversion to S.
template <class S, class X>
KTE_INLINE bool all_finite_as(const X& x, std::size_t n) {
  // Bounded arrays: g++ 12 warns of reads beyond the end for loops of unknown length.
  if constexpr (std::is_bounded_array_v<X>) n = std::extent_v<X>;
  if constexpr (requires { std::tuple_size<X>::value; }) n = std::tuple_size_v<X>;
  if constexpr (tree::stands_in_row<X, S>) {
    return tree::all_finite_in_row(tree::row_of<S>(x), n);
  } else {
    const S sum = sum_by_four<S>(n, [&x](std::size_t i) KTE_INLINE_LAMBDA { return S(static_cast<S>(x[i]) * S(0)); });
    return all(sum == S(0));
  }
}
/// Whether all numbers are finite and far from overflow. Returns false for numbers that are expensive to inspect.
template <class S, class X>
KTE_INLINE bool all_moderate_as(const X& x, std::size_t n) {
  if constexpr (std::is_floating_point_v<S> && tree::stands_in_row<X, S>)
    return tree::all_moderate_in_row(tree::row_of<S>(x), n);
  else
    return false;
}
/// Calls `why`, which throws, unless the forces or accelerations that a state returns are finite.
template <class S, class Diagnose>
KTE_INLINE void check_result(const basic_runtime_state<S>& s, const Diagnose& why) {
  if (!tree::all_finite_in_row(s.work.forces.data(), static_cast<std::size_t>(s.dofs()))) [[unlikely]]
    why();
}
/// Checks a position vector for a state. Returns whether all numbers are moderate.
template <class S, indexable Q>
KTE_INLINE bool check_positions(const basic_runtime_state<S>& s, const Q& q) {
  check_configuration(s.nq(), s.dofs(), q);
  const auto n = static_cast<std::size_t>(s.nq());
  const bool moderate = all_moderate_as<S>(q, n);
  position_check all;
  all.finite(moderate || all_finite_as<S>(q, n));
  for (const std::size_t i : s.made_for()->quaternions)
    all.rotation(static_cast<S>(q[i]), static_cast<S>(q[i + 1]), static_cast<S>(q[i + 2]), static_cast<S>(q[i + 3]));
  for_each_given_coordinate(s, [&all](const auto& c) { all.number(c.q); });
  if (!all.good()) [[unlikely]]
    diagnose_argument("a coordinate", s, q, "q", s.nq(), true);
  return moderate;
}

/// Placeholder for an argument that a call does not have.
struct not_given {};

/// Placeholder for accelerations that the call itself will store in the state.
struct found_later {};
template <class X>
inline constexpr bool is_put = !std::is_same_v<X, not_given> && !std::is_same_v<X, found_later>;

/// Checks rates, accelerations or forces. Returns whether all are moderate.
template <class S, class X>
KTE_INLINE bool check_numbers(const basic_runtime_state<S>& s, const X& x, const char* name, const char* what) {
  if constexpr (is_put<X>) {
    const auto n = static_cast<std::size_t>(s.dofs());
    check_size(n, x, name);
    if (all_moderate_as<S>(x, n)) [[likely]]
      return true;
    if (!all_finite_as<S>(x, n)) [[unlikely]]
      diagnose_argument(what, s, x, name, s.dofs());
    return false;
  } else {
    return true;
  }
}

/// Numbers of a state that a call replaces (q, v, a where true), saved to restore them if the call throws.
template <class S, bool Q, bool V, bool A>
struct replaced_numbers {
  basic_runtime_state<S>& state;
  bool kept;  ///< saved in `before` of the state

  /// Calls visit(number) for each number of a coordinate.
  template <class C, class Visit>
  KTE_INLINE static void each(C& c, const Visit& visit) {
    if constexpr (Q) visit_q(c, visit);
    if constexpr (V) visit_v(c, visit);
    if constexpr (A) visit_a(c, visit);
  }
  [[gnu::cold, gnu::noinline]] void keep() const {
    S* old = state.before.data();
    for_each_listed_freedom(state,
                            [&old](auto& c, const freedom&) { each(c, [&old](const S& number) { *old++ = number; }); });
  }
  [[gnu::cold, gnu::noinline]] void put_back() const {
    const S* old = state.before.data();
    for_each_listed_freedom(state,
                            [&old](auto& c, const freedom&) { each(c, [&old](S& number) { number = *old++; }); });
  }
  /// Returns body(). If it throws, the state is unchanged.
  template <class Body>
  KTE_INLINE decltype(auto) call(const Body& body) const {
    try {
      return body();
    } catch (...) {
      if (kept) put_back();
      throw;
    }
  }
};

/// When a call saves the numbers that it replaces.
enum class keeping {
  always,
  if_needed  ///< in calls that take no longer than that would matter, and that trees of bodies refuse for no reason but
             ///< large arguments (and signals or bases in the state that are none)
};
/// The numbers that `take` replaces. (Not `auto`, which users of kte::compiled would instantiate.)
template <class S, class V, class A>
using replaced_by = replaced_numbers<S, true, is_put<V>, !std::is_same_v<A, not_given>>;

/// Stores q, v, a in a state if they and tau are valid. If this throws, the state is unchanged.
template <keeping When = keeping::always, class S, class Q, class V = not_given, class A = not_given,
          class Tau = not_given>
replaced_by<S, V, A> take(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v = {},
                          const A& a = {}, const Tau& tau = {}) {
  c.check(s);
  const bool of_q = check_positions(s, q), of_v = check_numbers(s, v, "v", "a velocity"),
             of_a = check_numbers(s, a, "a", "an acceleration"), of_tau = check_numbers(s, tau, "tau", "a force");
  const bool moderate = of_q && of_v && of_a && of_tau;
  constexpr bool with_v = is_put<V>;
  const replaced_by<S, V, A> replaced{s, When == keeping::always || !moderate || !s.tree().only_bodies};
  const auto put_all = [&](auto& x, const freedom& at) KTE_INLINE_LAMBDA {
    put<vector_of::q>(x, at, q);
    if constexpr (with_v) put<vector_of::v>(x, at, v);
    if constexpr (is_put<A>) put<vector_of::a>(x, at, a);
  };
  if constexpr (When == keeping::always) {
    S* old = s.before.data();
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) KTE_INLINE_LAMBDA {
      replaced.each(x, [&old](const S& number) KTE_INLINE_LAMBDA { *old++ = number; });
      put_all(x, at);
    });
  } else {
    if (replaced.kept) [[unlikely]]
      replaced.keep();
    for_each_listed_freedom(s, put_all);
  }
  return replaced;
}
/// Saves the accelerations before a call that overwrites them and can still fail.
template <class S>
replaced_numbers<S, false, false, true> keep_accelerations(basic_runtime_state<S>& s) {
  const replaced_numbers<S, false, false, true> replaced{s, true};
  replaced.keep();
  return replaced;
}

#ifdef KTE_EXTERN
KTE_EXTERN template void check_positions(const runtime_state&);
KTE_EXTERN template void check_state_velocities(const runtime_state&);
KTE_EXTERN template struct replaced_numbers<double, true, false, false>;
KTE_EXTERN template struct replaced_numbers<double, true, true, false>;
KTE_EXTERN template struct replaced_numbers<double, true, true, true>;
KTE_EXTERN template struct replaced_numbers<double, false, false, true>;
#  define KTE_TAKE(When, V, A, Tau)                                                                \
    KTE_EXTERN template replaced_by<double, V, A> take<When>(const runtime_chain&, runtime_state&, \
                                                             const Eigen::VectorXd&, const V&, const A&, const Tau&)
KTE_TAKE(keeping::always, not_given, not_given, not_given);
KTE_TAKE(keeping::always, Eigen::VectorXd, not_given, not_given);
KTE_TAKE(keeping::always, Eigen::VectorXd, not_given, Eigen::VectorXd);
KTE_TAKE(keeping::always, Eigen::VectorXd, found_later, Eigen::VectorXd);
KTE_TAKE(keeping::always, Eigen::VectorXd, Eigen::VectorXd, not_given);
KTE_TAKE(keeping::if_needed, not_given, not_given, not_given);
KTE_TAKE(keeping::if_needed, Eigen::VectorXd, not_given, not_given);
KTE_TAKE(keeping::if_needed, Eigen::VectorXd, Eigen::VectorXd, not_given);
#  undef KTE_TAKE
#endif

}  // namespace kte::detail
