#ifndef KTE_INVERSE_DYNAMICS_HPP
#define KTE_INVERSE_DYNAMICS_HPP

// Included first, so that static_assert messages appear near the top.
// clang-format off
#include <kte/detail/unroll.hpp>
#include <kte/kernels/joint_vector.hpp>
// clang-format on

#include <kte/contract/transmission.hpp>
#include <kte/dynamics/looped/static_chains.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/dynamics/unrolled/flattened.hpp>
#include <kte/dynamics/unrolled/given.hpp>

namespace kte {

namespace detail {
/// Writes the numbers of the load on a coordinate of kind K to f[V], f[V + 1], ...
template <kind K, int V, class L, class Sign, class X>
KTE_INLINE void spread_load(const L& load, Sign sign, X& f) {
  using S = typename X::Scalar;
  if constexpr (nv_of(K) == 1)
    f[V] = as<S>(sign * number_of<K, 0>(load));
  else
    unroll<nv_of(K)>([&]<int N>() KTE_INLINE_LAMBDA { f[V + N] = as<S>(sign * number_of<K, N>(load)); });
}
/// The generalized forces on all degrees of freedom: those of virtual power (`sign` 1), or those to apply for the given
/// motion (`sign` -1).
template <class S, class Pass, class Sign>
KTE_INLINE auto forces_of(const Pass& pass, Sign sign) {
  using wiring = typename Pass::chain_type::wiring;
  joint_vector<S, wiring::dofs> f;
  unroll<wiring::freedoms>([&]<std::size_t I>() KTE_INLINE_LAMBDA {
    constexpr freedom at = wiring::template free<I>;
    spread_load<at.what, at.v>(pass.template load<at.what, at.slot>(), sign, f);
  });
  return f;
}
/// The generalized forces of a chain at the given arguments.
template <class S, class Chain, class Given, class Sign>
KTE_INLINE auto generalized_forces(const Chain& c, const Given& g, Sign sign) {
  const auto f = [&]() KTE_INLINE_LAMBDA {
    if constexpr (has_unrolled_passes<Chain, S>) {
      using pass = unrolled_passes<Chain, Given>;
      static_assert(sizeof(typename pass::need) > 0);
      return forces_of<S>(pass(c, g), sign);
    } else {
      return forces_by_tree<S>(c, g, sign);
    }
  }();
  check_forces<typename Chain::wiring>(f, g);
  return f;
}
}  // namespace detail

/// Inverse dynamics by the recursive Newton-Euler algorithm (RNEA; Luh, Walker, Paul 1980; Featherstone, Rigid Body
/// Dynamics Algorithms, 2008, section 5.3), with classical accelerations in body axes:
///
///   tau = M(q) a + C(q, v) v + g(q) - Q(q, v)          (1)
///
/// with the forces Q of springs, dampers and other elements of the chain, and the gravity of the chain. q, v, a:
/// positions (rad, m), velocities, accelerations of the degrees of freedom in the order of the layout of the chain
/// (static_chain/layout.hpp); anything with operator[]. Returns tau, dofs numbers, in Nm and N.
///
///   inverse_dynamics(c, q, v, a)       of a static chain, a value: bases at rest, inputs zero; no heap, no state
///   inverse_dynamics(c, s, q, v, a)    of a runtime chain, in the state s, which stores q, v, a and has the bases and
///                                      inputs; the result is valid until the next call with s
///   inverse_dynamics(c, s)             of both, at the positions, rates and accelerations of a state
///
/// Throws `bad_argument` for arguments of wrong size, numbers that are not finite, and quaternions of length zero;
/// runtime chains also for the state of another chain. All algorithms on runtime chains store their arguments q, v or a
/// in the state. They allocate memory of the size of M at most. If they throw, the positions, velocities and
/// accelerations of the state are unchanged, unless a signal or base of the state is the cause.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] auto inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_closures_of<chain_type>) > 0);
  detail::check_configuration<chain_type>(q), check_size<chain_type::dofs>(v, "v"),
      check_size<chain_type::dofs>(a, "a");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::in_one_function<S, detail::is_unrolled<chain_type, S>>([&]() KTE_INLINE_LAMBDA {
    return detail::generalized_forces<S>(
        c, detail::given{at, detail::each<S, V>{v}, detail::each<S, A>{a}, detail::base_under_gravity(c)}, minus_one);
  });
}

template <class Gravity, class... E, class S>
[[nodiscard]] auto inverse_dynamics(const static_chain<Gravity, E...>& c,
                                    const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  static_assert(sizeof(detail::check_closures_of<static_chain<Gravity, E...>>) > 0);
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  using vector = std::remove_const_t<decltype(v)>;
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return detail::generalized_forces<S>(
      c, detail::given{at, detail::each<S, vector>{v}, detail::each<S, vector>{a}, detail::base_of_state<state>{s}},
      minus_one);
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_INVERSE_DYNAMICS_OF_RUNTIME_CHAINS)
#define KTE_INVERSE_DYNAMICS_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/elements.hpp>
#include <kte/dynamics/runtime/refused_calls.hpp>

namespace kte {

namespace detail {
/// Throws `bad_argument` for a chain with contacts or closures, whose forces inverse dynamics does not know.
inline void refuse_constraint_forces(const runtime_chain& c) {
  refuse_contacts(c);
  refuse_loops(c, ": inverse_dynamics(c, s, q, v, a, kte::actuated(\"q1\")) of kte/loops.hpp does");
}
/// As `inverse_dynamics`, without the forces of contacts and closures.
template <class S>
const runtime_vector<S>& forces_at_state(const runtime_chain& c, basic_runtime_state<S>& s) {
  check_whole(c, s);
  bool by_passes = false;
  if constexpr (std::is_same_v<S, double>)
    if (s.tree().irregular) [[unlikely]]
      c.doMotion(s), c.clearForce(s), c.doForce(s), by_passes = true;
  if (!by_passes) forces_on_coordinates(runtime_elements{c}, s, acting::all);
  return applied_forces(s);
}
}  // namespace detail

template <class S>
const runtime_vector<S>& inverse_dynamics(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::refuse_constraint_forces(c);
  return detail::forces_at_state(c, s);
}
template <class S, indexable Q, indexable V, indexable A>
const runtime_vector<S>& inverse_dynamics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                          const A& a) {
  detail::refuse_constraint_forces(c);
  return detail::take<detail::keeping::if_needed>(c, s, q, v, a).call([&]() -> const auto& {
    return detail::forces_at_state(c, s);
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_vector<double>& detail::forces_at_state(const runtime_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& inverse_dynamics(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
