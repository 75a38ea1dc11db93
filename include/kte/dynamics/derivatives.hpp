#ifndef KTE_DERIVATIVES_HPP
#define KTE_DERIVATIVES_HPP

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/unrolled/derivatives.hpp>

namespace kte {

/// Inverse dynamics and its derivatives by q, v and a: tau, and three matrices of dofs x dofs. by_a is the mass matrix
/// minus the derivatives of load-dependent friction. For trees of joints and bodies with springs, dampers and masses on
/// coordinates, a recursion over the elements computes them (recursions/force_variations.hpp). Chains with other forces
/// between frames, or with dependent coordinates, use dual numbers.
///
///   inverse_dynamics_derivatives(c, q, v, a)       of a static chain, a value
///   inverse_dynamics_derivatives(c, s, q, v, a)    of a runtime chain, in the state s; the first call allocates
///   inverse_dynamics_derivatives(c, s)             of both, at the positions, rates and accelerations of a state
///
/// Arguments and errors as for `inverse_dynamics`. Throws `bad_argument` also for a chain with an element that has more
/// than the data of a body node.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] auto inverse_dynamics_derivatives(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const A& a) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(a, "a");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  at.check();
  return detail::derivatives_at<S>(c, at, detail::base_under_gravity(c), q, v, a);
}
template <class Gravity, class... E, class S>
[[nodiscard]] auto inverse_dynamics_derivatives(const static_chain<Gravity, E...>& c,
                                                const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  at.check();
  return detail::derivatives_at<S>(c, at, detail::base_of_state<state>{s}, q, v, a);
}

/// Forward dynamics and its derivatives by q, v and tau, from those of inverse dynamics and the inverse of the mass
/// matrix, with the accuracy of `mass_matrix_inverse`. Arguments and errors are those of `forward_dynamics`, results
/// those of `inverse_dynamics_derivatives`.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto forward_dynamics_derivatives(const static_chain<Gravity, E...>& c, const Q& q, const V& v,
                                                const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  constexpr int n = chain_type::dofs;
  detail::check_configuration<chain_type>(q), check_size<n>(v, "v"), check_size<n>(tau, "tau");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  joint_vector<S, n> f;
  for (int i = 0; i < n; ++i) f[i] = S(tau[static_cast<std::size_t>(i)]);
  return detail::forward_derivatives_at<S>(c, at, detail::base_under_gravity(c), q, v, f);
}
template <class Gravity, class... E, class S>
[[nodiscard]] auto forward_dynamics_derivatives(const static_chain<Gravity, E...>& c,
                                                const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  using vector = joint_vector<S, state::dofs>;
  return detail::forward_derivatives_at<S>(c, at, detail::base_of_state<state>{s}, q, v, vector(vector::Zero()));
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_DERIVATIVES_OF_RUNTIME_CHAINS)
#define KTE_DERIVATIVES_OF_RUNTIME_CHAINS

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/runtime/derivatives.hpp>

namespace kte {

template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& inverse_dynamics_derivatives(const runtime_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  return detail::forces_derived(c, s);
}
template <class S, indexable Q, indexable V, indexable A>
const auto& inverse_dynamics_derivatives(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const A& a) {
  detail::check_regular(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q, v, a).call([&]() -> const auto& {
    return detail::forces_derived(c, s);
  });
}

template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& forward_dynamics_derivatives(const runtime_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  return detail::keep_accelerations(s).call([&]() -> const auto& {
    forward_dynamics(c, s);
    return detail::accelerations_derived(c, s);
  });
}
template <class S, indexable Q, indexable V, indexable T>
const auto& forward_dynamics_derivatives(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const T& tau) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&]() -> const auto& {
    detail::keep_forces(s, [&](int i) { return static_cast<S>(tau[static_cast<std::size_t>(i)]); });
    detail::accelerations_at_state(c, s);
    return detail::accelerations_derived(c, s);
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& inverse_dynamics_derivatives(
    const runtime_chain&, runtime_state&);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& forward_dynamics_derivatives(
    const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
