#pragma once

#include <kte/dynamics/runtime/duals.hpp>
#include <kte/tree/solve_limbs.hpp>

/// Derivatives of inverse and forward dynamics of runtime chains, in the memory of a state.
namespace kte::detail {

/// Whether all elements of a chain provide the derivatives of their forces.
template <class S>
bool is_known_by_elements(const runtime_chain& c, const basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  return t.body_tree.varying.empty() && t.on_frames.empty() && t.followers.empty() && t.late.empty() &&
         t.readers.empty() && c.wiring().has_derivatives;
}
template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& forces_derived(const runtime_chain& c, basic_runtime_state<S>& s,
                                                                 bool moved = false) {
  forces_on_coordinates(runtime_elements{c}, s, acting::all, true, moved);
  take_generalized_forces(s);
  auto& r = s.work.of_forces;
  if constexpr (std::is_same_v<S, double>) {
    if (is_known_by_elements(c, s)) [[likely]]
      derive_forces(runtime_elements{c}, s);
    else
      derive_forces_by_duals(c, s);
  } else {  // joints, links and bodies only
    derive_forces(runtime_elements{c}, s);
  }
  r.tau = s.work.forces;
  check_result(r.tau, static_cast<std::size_t>(s.dofs()), [&s] { diagnose("a force", s); });
  return r;
}
/// Derivatives of forward dynamics, after forward dynamics: (1) of dynamics/unrolled/derivatives.hpp.
template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& accelerations_derived(const runtime_chain& c,
                                                                        basic_runtime_state<S>& s) {
  auto& r = s.work.of_accelerations;
  const Eigen::Index n = s.dofs();
  r.a = s.work.forces;
  r.by_q.resize(n, n), r.by_v.resize(n, n);
  if constexpr (std::is_same_v<S, double>)
    if (!s.tree().readers.empty()) [[unlikely]] {
      const auto& forces = forces_derived(c, s);
      invert_free_rows_with_friction(runtime_elements{c}, s, forces.by_a, r.by_tau);
      solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
      return r;
    }
  if (s.tree().plan.tree && s.tree().locks.empty()) [[likely]]
    invert_articulated(s, r.by_tau);
  else
    invert_free_rows(runtime_elements{c}, s, r.by_tau);
  const auto& forces = forces_derived(c, s, true);
  const auto& t = s.tree();
  if (t.locks.empty() && t.body_tree.in_order && static_cast<Eigen::Index>(t.body_tree.axes()) == n)
    tree::solve_limbs(t.body_tree, !t.only_bodies, s.work.rows, r.by_tau.data(), forces.by_q.data(), forces.by_v.data(),
                      r.by_q.data(), r.by_v.data());
  else
    solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
  return r;
}

#ifdef KTE_EXTERN
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& forces_derived(const runtime_chain&,
                                                                                          runtime_state&, bool);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& accelerations_derived(const runtime_chain&,
                                                                                                 runtime_state&);
#endif

}  // namespace kte::detail
