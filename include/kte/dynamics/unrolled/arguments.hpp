#pragma once

#include <kte/dynamics/unrolled/given.hpp>

namespace kte::detail {

/// Rejects velocities or accelerations of the wrong size, and non-finite ones.
template <class Chain, class V>
KTE_INLINE void check_rates(const V& v, const char* name, const char* what) {
  check_size<Chain::dofs>(v, name);
  check_result(v, std::size_t{Chain::dofs}, [&]() KTE_INLINE_LAMBDA {
    diagnose_rates<typename Chain::wiring>(what, name, each<value_of<V>, V>{v});
  });
}
template <class Chain, class V>
KTE_INLINE void check_velocities(const V& v) {
  check_rates<Chain>(v, "v", "a velocity");
}
/// The checked arguments of a call on a static chain: their sizes are right and all numbers are finite.
template <class Chain, class Q, class V, class A>
struct arguments_of_call {
  using wiring = typename Chain::wiring;
  configuration<value_of<Q>, wiring, Q> at;
  V v;
  A a;

  KTE_INLINE arguments_of_call(const Q& q, V of_v, A of_a) : at(q), v(of_v), a(of_a) { at.check(); }
  /// Diagnoses a result that is not finite, by its name with an article: names the argument that is too large.
  KTE_INLINE auto diagnosis(const char* what) const {
    return [this, what]() KTE_INLINE_LAMBDA { diagnose<wiring>(what, at.q, v, a, "a"); };
  }
};
template <class Chain, class Q>
KTE_INLINE auto checked_arguments(const Q& q) {
  check_configuration<Chain>(q);
  return arguments_of_call<Chain, Q, same<zero_t>, same<zero_t>>(q, {}, {});
}
template <class Chain, class Q, class V>
KTE_INLINE auto checked_arguments(const Q& q, const V& v) {
  check_configuration<Chain>(q), check_velocities<Chain>(v);
  return arguments_of_call<Chain, Q, each<value_of<Q>, V>, same<zero_t>>(q, {v}, {});
}
template <class Chain, class Q, class V, class A>
KTE_INLINE auto checked_arguments(const Q& q, const V& v, const A& a) {
  check_configuration<Chain>(q), check_velocities<Chain>(v), check_rates<Chain>(a, "a", "an acceleration");
  return arguments_of_call<Chain, Q, each<value_of<Q>, V>, each<value_of<Q>, A>>(q, {v}, {a});
}

}  // namespace kte::detail
