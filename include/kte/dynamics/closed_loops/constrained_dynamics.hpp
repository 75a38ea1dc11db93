#pragma once

#include <kte/dynamics/closed_loops/forward.hpp>
#include <kte/dynamics/closed_loops/loop_results.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#ifdef KTE_FUNCTION
#  include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#endif

namespace kte {

namespace detail {
loops_report loops_at_state(const runtime_chain& c, runtime_state& s);
constrained_dynamics_result constrained_dynamics_at_state(const runtime_chain& c, runtime_state& s,
                                                          const Eigen::VectorXd& tau);
const Eigen::VectorXd& velocities_on_loops(const runtime_chain& c, runtime_state& s);
Eigen::MatrixXd loop_jacobian_at_state(const runtime_chain& c, runtime_state& s);
}  // namespace detail

/// Accelerations of a chain with loops, and the forces of its closures (Featherstone, Rigid Body Dynamics Algorithms,
/// 2008, chapter 8), with J the constraint Jacobian:
///
///   M a = tau - bias + J^T lambda,   J a = -J_dot v          (1)
///
/// by a column-pivoted QR factorisation of L^-T J^T, M = L^T L, so that redundant closures are no harm: a and J^T
/// lambda do not depend on which rows are taken. The force of a single redundant closure does: rows in `dependent` get
/// none. Singular configurations are met to 1e-10 of the largest pivot.
///
///   constrained_dynamics(c, s, q, v, tau)    r.a, r.loop("pin").force, r.rank, r.mobility, r.dependent
///
/// The state gets accelerations and forces, too; positions and velocities should be on the loops. Arguments and errors
/// as for `forward_dynamics`; throws `bad_argument` for a closure on a frame that follows others, and for joints that
/// may be held or have friction by what they carry.
template <indexable Q, indexable V, indexable T>
constrained_dynamics_result constrained_dynamics(const runtime_chain& c, runtime_state& s, const Q& q, const V& v,
                                                 const T& tau) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&] {
    Eigen::VectorXd forces(s.dofs());
    for (int i = 0; i < s.dofs(); ++i) forces[i] = static_cast<double>(tau[static_cast<std::size_t>(i)]);
    return detail::constrained_dynamics_at_state(c, s, forces);
  });
}

/// The number of rows of the closures of a chain at q, the number of independent rows, and the dependent rows.
template <indexable Q>
loops_report loops(const runtime_chain& c, runtime_state& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::loops_at_state(c, s); });
}

/// The Jacobian of all closures, J: the rates of the residuals, m/s and rad/s, are J v. Rows are in the order of the
/// chain, of each closure those in m first.
template <indexable Q>
Eigen::MatrixXd loop_jacobian(const runtime_chain& c, runtime_state& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::loop_jacobian_at_state(c, s); });
}

/// The velocities nearest to v, in kinetic energy, with closed loops: J v = 0. They are stored in the state.
template <indexable Q, indexable V>
Eigen::VectorXd consistent_velocities(const runtime_chain& c, runtime_state& s, const Q& q, const V& v) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&]() -> Eigen::VectorXd { return detail::velocities_on_loops(c, s); });
}
/// The velocities after an event has activated closures, without bounce: a plastic impact. The impulses are J^T of
/// those of the closures, so that the velocities are those of `consistent_velocities`.
template <indexable Q, indexable V>
Eigen::VectorXd impulse(const runtime_chain& c, runtime_state& s, const Q& q, const V& v) {
  return consistent_velocities(c, s, q, v);
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte::detail {

/// The names of rows that are not chosen.
inline std::vector<std::string> dependent_rows(const runtime_chain& c, const loop_equations& e,
                                               const loop_factor& factor) {
  const Eigen::VectorXd chosen = factor.chosen_of(e, Eigen::VectorXd::Ones(e.places.rows));
  std::vector<std::string> names;
  for (int k = 0; k < e.places.rows; ++k)
    if (chosen[k] == 0) names.push_back(e.places.name_of_row(c, k));
  return names;
}
/// Rows chosen at the positions of the state.
inline loop_memory_of_state& factorized_loops(const runtime_chain& c, runtime_state& s) {
  auto& m = loops_of(c, s);
  m.equations.at_positions(c, s, true);
  m.factor.choose(c, s, m.equations, least_pivot_at(m.equations.residual));
  return m;
}
KTE_FUNCTION loops_report loops_at_state(const runtime_chain& c, runtime_state& s) {
  loops_report r;
  r.mobility = s.dofs();
  if (!has_loops(c)) return r;
  const auto& [layout, e, factor] = factorized_loops(c, s);
  r.rows = e.places.rows, r.rank = factor.rank(), r.mobility = s.dofs() - r.rank;
  for (const auto& p : factor.parts)
    if (p.largest > 0) r.pivot_ratio = (std::min)(r.pivot_ratio, p.smallest / p.largest);
  const auto widest = widest_gap(e);
  r.gap = widest.size, r.widest = closure_places::name_of(c, *widest.closure);
  r.dependent = dependent_rows(c, e, factor);
  for (const auto& b : e.places.blocks) {
    std::string names;
    for (const int k : b.closures)
      names.append(names.empty() ? "" : ", ")
          .append(closure_places::name_of(c, e.places.closures[static_cast<std::size_t>(k)]));
    r.blocks.push_back(names);
  }
  return r;
}
KTE_FUNCTION constrained_dynamics_result constrained_dynamics_at_state(const runtime_chain& c, runtime_state& s,
                                                                       const Eigen::VectorXd& tau) {
  constrained_dynamics_result r;
  r.a = accelerations_of_chain(c, s, [&tau](int i) { return tau[i]; });
  r.mobility = s.dofs();
  if (!has_loops(c)) return r;
  const auto& [layout, e, factor] = loops_of(c, s);
  r.rank = factor.rank(), r.mobility = s.dofs() - r.rank;
  r.dependent = dependent_rows(c, e, factor);
  for (const auto& x : e.places.closures) {
    r.names.push_back(closure_places::name_of(c, x));
    r.loops.push_back(s.get<kind::loop>(x.loop));
    for (int k = 0; k < x.rows.count(); ++k)
      row_of(r.loops.back().residual, r.loops.back().ang_residual, x.rows, k) =
          e.residual[x.first + k] / e.places.scale(x, k);
  }
  return r;
}
KTE_FUNCTION const Eigen::VectorXd& velocities_on_loops(const runtime_chain& c, runtime_state& s) {
  Eigen::VectorXd v = read_numbers<vector_of::v>(s);
  if (has_loops(c)) {
    const auto& [layout, e, factor] = factorized_loops(c, s);
    for (int i = 0; i < 2; ++i) v -= factor.least_change(e, e.times(v));  // the second takes rounding away
    write_numbers<vector_of::v>(s, v, "v");
  }
  s.work.forces = v;
  return s.work.forces;
}
KTE_FUNCTION Eigen::MatrixXd loop_jacobian_at_state(const runtime_chain& c, runtime_state& s) {
  if (!has_loops(c)) return Eigen::MatrixXd(0, s.dofs());
  auto& m = loops_of(c, s);
  m.equations.at_positions(c, s, true);
  return m.equations.dense_jacobian();
}

}  // namespace kte::detail
#endif
