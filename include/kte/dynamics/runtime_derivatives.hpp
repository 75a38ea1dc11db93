#pragma once

#include <kte/dynamics/detail/runtime_duals.hpp>
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/dynamics/runtime.hpp>
#include <kte/tree/solve_limbs.hpp>

#include <string_view>
#include <vector>

/// What static chains have in dynamics/{mass_matrix_inverse,derivatives,hybrid_dynamics}.hpp, on runtime chains.
/// Results are in the memory of the state, valid until the next call with it; the first call makes that memory. (Hybrid
/// dynamics returns a value.)
namespace kte {

namespace detail {
/// Whether the derivatives of the forces of a chain are known element by element.
template <class S>
bool is_known_by_elements(const kte_map_chain& c, const basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  return t.on_frames.empty() && t.followers.empty() && t.late.empty() && t.readers.empty() &&
         c.wiring().has_derivatives;
}

/// At positions that are good.
template <class S>
const runtime_matrix<S>& inverse_of_masses(const kte_map_chain& c, basic_runtime_state<S>& s) {
  runtime_matrix<S>& inverse = s.work.inverse;
  if (s.tree().plan.tree) {
    articulate_and_invert(runtime_elements{c}, s, inverse);
  } else {
    mass_of_coordinates(runtime_elements{c}, s);
    inverse.resize(s.dofs(), s.dofs());
    invert_by_factors(s.work.mass, inverse, [&s](int row) { blame_mass(s, row, true); });
  }
  check_inverse(s, inverse);
  return inverse;
}
}  // namespace detail

/// The inverse of the mass matrix at the state's positions. As `mass_matrix_inverse` on a static chain.
template <class S>
const runtime_matrix<S>& mass_matrix_inverse(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  return detail::inverse_of_masses(c, s);
}
/// The same at q, which is put into the state.
template <class S, indexable Q>
const runtime_matrix<S>& mass_matrix_inverse(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular(c, s);
  return detail::take(c, s, q).call([&]() -> const auto& { return detail::inverse_of_masses(c, s); });
}

namespace detail {
template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& forces_derived(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 bool moved = false) {
  coordinate_forces(c, s, moved);
  take_needed_forces(s);
  auto& r = s.work.of_forces;
  if constexpr (std::is_same_v<S, double>) {
    if (is_known_by_elements(c, s)) [[likely]]
      derive_forces(runtime_elements{c}, s);
    else
      derive_forces_by_duals(c, s);
  } else {  // joints, links and bodies alone
    derive_forces(runtime_elements{c}, s);
  }
  r.tau = s.work.forces;
  check_result(r.tau, static_cast<std::size_t>(s.dofs()), [&s] { blame("a force", s); });
  return r;
}
}  // namespace detail

/// Inverse dynamics and its derivatives at the state's positions, rates and accelerations. As
/// `inverse_dynamics_derivatives` on a static chain, for trees of joints and bodies with forces and masses on
/// coordinates; others throw `bad_argument`.
template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& inverse_dynamics_derivatives(const kte_map_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  return detail::forces_derived(c, s);
}
/// The same at q, v, a, which are put into the state.
template <class S, indexable Q, indexable V, indexable A>
const auto& inverse_dynamics_derivatives(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const A& a) {
  detail::check_regular(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q, v, a).call([&]() -> const auto& {
    return detail::forces_derived(c, s);
  });
}

namespace detail {
/// After forward dynamics: (1) of dynamics/derivatives.hpp.
template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& accelerations_derived(const kte_map_chain& c,
                                                                        basic_runtime_state<S>& s) {
  auto& r = s.work.of_accelerations;
  const Eigen::Index n = s.dofs();
  r.a = s.work.forces;
  r.by_q.resize(n, n), r.by_v.resize(n, n);
  if constexpr (std::is_same_v<S, double>)
    if (!s.tree().readers.empty()) [[unlikely]] {
      const auto& forces = forces_derived(c, s);
      invert_unheld_rubbing(runtime_elements{c}, s, forces.by_a, r.by_tau);
      solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
      return r;
    }
  if (s.tree().plan.tree && s.tree().holders.empty()) [[likely]]
    invert_articulated(s, r.by_tau);
  else
    invert_unheld(runtime_elements{c}, s, r.by_tau);
  const auto& forces = forces_derived(c, s, true);
  const auto& t = s.tree();
  if (t.holders.empty() && t.forest.in_order && static_cast<Eigen::Index>(t.forest.axes()) == n)
    tree::solve_limbs(t.forest, !t.only_bodies, s.work.rows, r.by_tau.data(), forces.by_q.data(), forces.by_v.data(),
                      r.by_q.data(), r.by_v.data());
  else
    solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
  return r;
}
}  // namespace detail

/// Forward dynamics and its derivatives at the state's positions and rates under its inputs. As
/// `forward_dynamics_derivatives` on a static chain, for chains as above.
template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& forward_dynamics_derivatives(const kte_map_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  return detail::keep_accelerations(s).call([&]() -> const auto& {
    forward_dynamics(c, s);
    return detail::accelerations_derived(c, s);
  });
}
/// The same at q, v, which are put into the state, under forces tau besides those of the chain's elements.
template <class S, indexable Q, indexable V, indexable T>
const auto& forward_dynamics_derivatives(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const T& tau) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&]() -> const auto& {
    detail::accelerations_under(c, s, [&](int i) { return static_cast<S>(tau[static_cast<std::size_t>(i)]); });
    return detail::accelerations_derived(c, s);
  });
}

/// As `hybrid_dynamics` on a static chain: known accelerations of the coordinates named, forces on all others.
///
///   const auto r = kte::hybrid_dynamics(arm, s, q, v, known, {"shoulder", "elbow"});
template <class S, indexable Q, indexable V, indexable X>
hybrid_dynamics_result<S, Eigen::Dynamic> hybrid_dynamics(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q,
                                                          const V& v, const X& known,
                                                          const std::vector<std::string_view>& prescribed) {
  using namespace detail;
  check_regular(c, s);
  const auto n = static_cast<std::size_t>(s.dofs());
  check_size(n, known, "known");
  std::vector<char> is_known(n, 0);
  for (const auto& name : prescribed) {
    const kind k = c.wiring().kind_of(name, false);
    const int slot = c.wiring().find(name, k);
    const auto at = std::find_if(s.freedoms().begin(), s.freedoms().end(),
                                 [&](const freedom& f) { return f.what == k && f.slot == slot; });
    if (at == s.freedoms().end())
      throw bad_argument("kte: '" + std::string(name) + "' is not a degree of freedom of this chain");
    for (int i = 0; i < nv_of(k); ++i) is_known[static_cast<std::size_t>(at->v + i)] = 1;
  }
  runtime_vector<S> given = runtime_vector<S>::Zero(s.dofs()), force = given;
  for (std::size_t i = 0; i < n; ++i)
    (is_known[i] ? given : force)[static_cast<Eigen::Index>(i)] = static_cast<S>(known[i]);
  return take(c, s, q, v, given, force).call([&] {
    hybrid_dynamics_result<S, Eigen::Dynamic> r;
    r.a = accelerations_under(
        c, s, [&force](int i) { return force[i]; }, is_known);
    r.tau = inverse_dynamics(c, s);
    for (std::size_t i = 0; i < n; ++i)  // what is known is given back as it came
      if (!is_known[i]) r.tau[static_cast<Eigen::Index>(i)] = force[static_cast<Eigen::Index>(i)];
    return r;
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_matrix<double>& mass_matrix_inverse(const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template const runtime_matrix<double>& inverse_of_masses(const kte_map_chain&, runtime_state&);
}
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& inverse_dynamics_derivatives(
    const kte_map_chain&, runtime_state&);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& forward_dynamics_derivatives(
    const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& forces_derived(const kte_map_chain&,
                                                                                          runtime_state&, bool);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& accelerations_derived(const kte_map_chain&,
                                                                                                 runtime_state&);
}  // namespace detail
#endif

}  // namespace kte
