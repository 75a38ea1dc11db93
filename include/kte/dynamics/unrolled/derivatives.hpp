#pragma once

#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/looped/dual_derivatives.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>
#include <kte/dynamics/unrolled/column_groups.hpp>
#include <kte/dynamics/unrolled/coordinate_derivatives.hpp>
#include <kte/dynamics/unrolled/force_derivatives.hpp>

/// Derivatives of inverse and forward dynamics of static chains.
namespace kte::detail {

template <class Core>
struct lacks_derivatives : std::bool_constant<!has_derivatives<Core>> {};
/// Whether all elements of a chain provide their derivatives.
template <class Chain>
inline constexpr bool is_analytical =
    is_tree_of_joints<Chain>&& Chain::common&& std::is_void_v<first_element<Chain, lacks_derivatives>>;

/// The derivatives at q, v and a, with given bases and inputs.
template <class S, class Chain, class At, class Base, class Q, class V, class A>
KTE_INLINE auto derivatives_at(const Chain& c, const At& at, const Base& base, const Q& q, const V& v, const A& a) {
  static_assert(sizeof(check_loads_of<Chain>) > 0 && sizeof(check_closures_of<Chain>) > 0);
  inverse_dynamics_result<S, Chain::dofs> r;
  if constexpr (is_analytical<Chain>) {
    const given g{at, each<S, V>{v}, each<S, A>{a}, base};
    if constexpr (is_unrolled<Chain, S>) {
      r.by_q.setZero(), r.by_v.setZero(), r.by_a.setZero();
      const unrolled_passes<Chain, std::remove_const_t<decltype(g)>> pass(c, g);
      write_force_derivatives<S>(pass, r);
      subtract_coordinate_derivatives<S>(c, g, r);
      r.tau = forces_of<S>(pass, minus_one);
    } else {
      derivatives_by_tree<S>(c, g, r);
    }
    check_forces<typename Chain::wiring>(r.tau, g);
  } else {
    dual_derivatives<S>(c, base, q, v, a, r);
    if constexpr (!has_load_dependent_friction<Chain>) r.by_a = mass_matrix_at<S>(c, at, base);
  }
  return r;
}

/// From accelerations a under tau and the derivatives of inverse dynamics there:
///
///   da/dq = -M^-1 dtau/dq,   da/dv = -M^-1 dtau/dv,   da/dtau = M^-1          (1)
///
/// with dtau/da instead of M if friction depends on what joints carry, and so on accelerations.
template <class S, class Chain, class At, class Base, class Q, class V>
KTE_INLINE auto forward_derivatives_at(const Chain& c, const At& at, const Base& base, const Q& q, const V& v,
                                       const joint_vector<S, Chain::dofs>& tau) {
  forward_dynamics_result<S, Chain::dofs> r;
  const each<S, V> rates{v};
  constexpr bool load_dependent = has_load_dependent_friction<Chain>,
                 inverted = !load_dependent && (is_tree_of_joints<Chain> || !Chain::common);
  if constexpr (inverted) {
    at.check(), base.check();
    const given<At, each<S, V>, same<zero_t>, Base, true> g{at, rates, {}, base};
    if constexpr (is_unrolled<Chain, S>) {
      inverted_mass<S, Chain, std::remove_const_t<decltype(g)>>(c, g).accelerate_and_invert(tau, r.a, r.by_tau);
    } else {
      accelerations_and_inverse_by_tree<S>(c, g, tau, r.a, r.by_tau);
    }
  } else {
    r.a = accelerations_under<S>(c, at, rates, base, tau);
  }
  auto of_forces = derivatives_at<S>(c, at, base, q, v, r.a);
  if constexpr (load_dependent)
    invert_by_tree<S>(c, given{at, rates, same<zero_t>{}, base}, of_forces.by_a, r.by_tau);
  else if constexpr (!inverted)
    invert_by_factors(of_forces.by_a, r.by_tau,
                      [&at](int row) { diagnose_mass<typename Chain::wiring>(row, true, at.q); });
  if constexpr (is_unrolled<Chain, S>)
    solve_by_groups<Chain, is_analytical<Chain>>(r.by_tau, of_forces.by_q, of_forces.by_v, r.by_q, r.by_v);
  else
    solve_by_inverse(r.by_tau, of_forces.by_q, r.by_q), solve_by_inverse(r.by_tau, of_forces.by_v, r.by_v);
  return r;
}

}  // namespace kte::detail
