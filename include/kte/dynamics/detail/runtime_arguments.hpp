#pragma once

#include <kte/dynamics/runtime_vectors.hpp>
#include <kte/runtime_chain/kte_map_chain.hpp>
#include <kte/tree/finite.hpp>

#include <tuple>
#include <type_traits>

/// The arguments of the algorithms on runtime chains.
namespace kte::detail {

/// visit(c) for generalized coordinates that are given from outside, by base_gen.
template <class State, class Visit>
void for_each_given_coordinate(State& s, const Visit& visit) {
  const auto& plan = s.tree().plan;
  if (plan.coordinates == s.dofs()) return;
  const auto& writers = s.made_for()->writers[static_cast<std::size_t>(kind::gen)];
  for (std::size_t i = 0; i < writers.size(); ++i)
    if (plan.row_of_gen[i] >= s.dofs() && writers[i] < 0) visit(s.template get<kind::gen>(static_cast<int>(i)));
}

/// Whether positions can be computed with.
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
  /// A quaternion of any length but zero.
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

/// Throws `bad_argument` that names the number at fault, of one vector of arguments for a state.
template <class S, class X>
[[noreturn, gnu::cold, gnu::noinline]] void blame_argument(const char* what, const basic_runtime_state<S>& s,
                                                           const X& x, const char* name, int n,
                                                           bool configuration = false) {
  runtime_vector<S> numbers(n);
  for (int i = 0; i < n; ++i) numbers[i] = static_cast<S>(x[static_cast<std::size_t>(i)]);
  const auto all = plain_numbers(numbers);
  const auto layout = layout_of_state(s);
  if (configuration && std::is_convertible_v<S, double>) raise_if_no_rotation(layout, all);
  raise_not_finite(what, layout, {{name, all, configuration}});
}

/// Of a state.
template <class S>
void check_positions(const basic_runtime_state<S>& s) {
  position_check all;
  for_each_listed_freedom(s, [&all](const auto& c, const freedom&) { all.coordinate(c); });
  for_each_given_coordinate(s, [&all](const auto& c) { all.number(c.q); });
  if (!all.good()) [[unlikely]]
    blame("a coordinate", s);
}
/// Whether n numbers are finite as numbers of S.
template <class S, class X>
KTE_INLINE bool all_finite_as(const X& x, std::size_t n) {
  // Of arrays g++ 12 takes a loop to a number that it does not know for one beyond their end.
  if constexpr (std::is_bounded_array_v<X>) n = std::extent_v<X>;
  if constexpr (requires { std::tuple_size<X>::value; }) n = std::tuple_size_v<X>;
  if constexpr (tree::stands_in_row<X, S>) {
    return tree::all_finite_in_row(tree::row_of<S>(x), n);
  } else {
    const S sum = sum_by_four<S>(n, [&x](std::size_t i) KTE_INLINE_LAMBDA { return S(static_cast<S>(x[i]) * S(0)); });
    return all(sum == S(0));
  }
}
/// Throws by `why` unless the forces or accelerations that a state gives back are finite.
template <class S, class Blame>
KTE_INLINE void check_result(const basic_runtime_state<S>& s, const Blame& why) {
  if (!tree::all_finite_in_row(s.work.forces.data(), static_cast<std::size_t>(s.dofs()))) [[unlikely]]
    why();
}
/// Of a vector, for a state.
template <class S, indexable Q>
KTE_INLINE void check_positions(const basic_runtime_state<S>& s, const Q& q) {
  check_configuration(s.nq(), s.dofs(), q);
  position_check all;
  all.finite(all_finite_as<S>(q, static_cast<std::size_t>(s.nq())));
  for (const std::size_t i : s.made_for()->quaternions)
    all.rotation(static_cast<S>(q[i]), static_cast<S>(q[i + 1]), static_cast<S>(q[i + 2]), static_cast<S>(q[i + 3]));
  for_each_given_coordinate(s, [&all](const auto& c) { all.number(c.q); });
  if (!all.good()) [[unlikely]]
    blame_argument("a coordinate", s, q, "q", s.nq(), true);
}

/// What a call is not given.
struct not_given {};

template <class S, class X>
KTE_INLINE void check_numbers(const basic_runtime_state<S>& s, const X& x, const char* name, const char* what) {
  if constexpr (!std::is_same_v<X, not_given>) {
    const auto n = static_cast<std::size_t>(s.dofs());
    check_size(n, x, name);
    if (!all_finite_as<S>(x, n)) [[unlikely]]
      blame_argument(what, s, x, name, s.dofs());
  }
}

/// Puts q, v, a into a state, but only if they and tau are all good: when this throws, the state is as it was.
template <class S, class Q, class V = not_given, class A = not_given, class Tau = not_given>
void take(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v = {}, const A& a = {},
          const Tau& tau = {}) {
  c.check(s);
  check_positions(s, q);
  check_numbers(s, v, "v", "a velocity");
  check_numbers(s, a, "a", "an acceleration");
  check_numbers(s, tau, "tau", "a force");
  const auto put_all = [&](auto& x, const freedom& at) KTE_INLINE_LAMBDA {
    put<vector_of::q>(x, at, q);
    if constexpr (!std::is_same_v<V, not_given>) put<vector_of::v>(x, at, v);
    if constexpr (!std::is_same_v<A, not_given>) put<vector_of::a>(x, at, a);
  };
  for_each_listed_freedom(s, put_all);
}

#ifdef KTE_EXTERN
KTE_EXTERN template void check_positions(const runtime_state&);
#  define KTE_TAKE(...) \
    KTE_EXTERN template void take(const kte_map_chain&, runtime_state&, const Eigen::VectorXd&, __VA_ARGS__)
KTE_TAKE(const not_given&, const not_given&, const not_given&);
KTE_TAKE(const Eigen::VectorXd&, const not_given&, const not_given&);
KTE_TAKE(const Eigen::VectorXd&, const Eigen::VectorXd&, const not_given&);
KTE_TAKE(const Eigen::VectorXd&, const not_given&, const Eigen::VectorXd&);
#  undef KTE_TAKE
#endif

}  // namespace kte::detail
