#pragma once

#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/closed_loops/loop_results.hpp>
#include <kte/dynamics/runtime/accelerations.hpp>
#include <kte/runtime_chain.hpp>

namespace kte {

namespace detail {
loops_report loops_at_state(const runtime_chain& c, runtime_state& s);
const constrained_dynamics_result& constrained_dynamics_under_kept(const runtime_chain& c, runtime_state& s);
const Eigen::VectorXd& velocities_on_loops(const runtime_chain& c, runtime_state& s);
Eigen::MatrixXd loop_jacobian_at_state(const runtime_chain& c, runtime_state& s);
}  // namespace detail

/// Accelerations of a chain with loops, and the forces of its closures (Featherstone, Rigid Body Dynamics Algorithms,
/// 2008, chapter 8), with J the constraint Jacobian:
///
///   M a = tau - bias + J^T lambda,   J a = -J_dot v          (1)
///
/// by articulated bodies and a column-pivoted QR factorization of L^-T J^T, M = L^T L, so that redundant closures are
/// harmless: a and J^T lambda do not depend on the choice of independent rows. The force of a single redundant closure
/// does; rows in `dependent` get no force. Singular configurations are resolved to 1e-10 of the largest pivot.
///
///   constrained_dynamics(c, s, q, v, tau)    r.a, r.loop("pin").force, r.rank, r.mobility, r.dependent
///
/// The result is in the memory of the state, until the next call. Coordinates and loops of the state get accelerations
/// and forces. Off the loops, where `gap` is above rounding, J a = -J_dot v holds, and they stay open. Arguments and
/// errors as for `forward_dynamics`, which refuses open loops; throws `bad_argument` for a closure on a frame that
/// follows others, for joints that may be held, and for load-dependent friction.
template <indexable Q, indexable V, indexable T>
const constrained_dynamics_result& constrained_dynamics(const runtime_chain& c, runtime_state& s, const Q& q,
                                                        const V& v, const T& tau) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&]() -> const auto& {
    for (int i = 0; i < s.dofs(); ++i)
      s.work.kept[static_cast<std::size_t>(i)] = static_cast<double>(tau[static_cast<std::size_t>(i)]);
    return detail::constrained_dynamics_under_kept(c, s);
  });
}

/// The number of rows of the closures of a chain at q, the number of independent rows, and the dependent rows.
template <indexable Q>
loops_report loops(const runtime_chain& c, runtime_state& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::loops_at_state(c, s); });
}

/// The Jacobian J of all closures: the rates of the residuals, m/s and rad/s, are J v. Rows are in the order of the
/// chain; for each closure those in m come first.
template <indexable Q>
Eigen::MatrixXd loop_jacobian(const runtime_chain& c, runtime_state& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q).call([&] { return detail::loop_jacobian_at_state(c, s); });
}

/// The velocities nearest to v, measured by kinetic energy, that keep the loops closed: J v = 0. Given motions of the
/// state, those of bases and of coordinates and frames that signals move, are kept:
///
///   J v + g' = 0,   g': the rates of the residuals while the degrees of freedom are at rest          (2)
///
/// The result is stored in the state. Throws `bad_argument`, naming a closure, if no velocities satisfy (2).
template <indexable Q, indexable V>
Eigen::VectorXd consistent_velocities(const runtime_chain& c, runtime_state& s, const Q& q, const V& v) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v).call([&]() -> Eigen::VectorXd { return detail::velocities_on_loops(c, s); });
}
/// The velocities after an event that activates closures, without bounce: a plastic impact. The impulses are J^T times
/// those of the closures, so that the velocities equal those of `consistent_velocities`.
template <indexable Q, indexable V>
Eigen::VectorXd impulse(const runtime_chain& c, runtime_state& s, const Q& q, const V& v) {
  return consistent_velocities(c, s, q, v);
}

}  // namespace kte

namespace kte::detail {

/// The names of dependent rows.
std::vector<std::string> dependent_rows(const chain_constraints& c, const loop_equations& e, const loop_factor& factor);
/// Selects the independent rows at the positions of the state.
inline loop_memory_of_state& factorized_loops(const runtime_chain& c, runtime_state& s) {
  auto& m = loops_of(c, s);
  factorize_loops(closures_of(c), s, m);
  return m;
}
/// The report; call `factorize_loops` first.
loops_report report_of(const chain_constraints& c, const loop_workspace& m, int dofs);
/// Projects velocities onto the loops, J v = -(the rates by given motions); call `factorize_loops` first. The second
/// projection removes rounding errors. Raises `bad_argument` if given motions do not keep the loops closed.
void put_on_loops(const chain_constraints& c, runtime_state& s, loop_workspace& m, Eigen::VectorXd& v);
inline void check_velocities_on_loops(const Eigen::VectorXd& v) {
  if (!tree::all_finite_in_row(v.data(), static_cast<std::size_t>(v.size()))) [[unlikely]]
    too_large{"a velocity"}();
}
#ifdef KTE_FUNCTION
KTE_FUNCTION loops_report loops_at_state(const runtime_chain& c, runtime_state& s) {
  if (has_loops(c)) return report_of(closures_of(c), factorized_loops(c, s), s.dofs());
  loops_report r;
  r.mobility = s.dofs();
  return r;
}
KTE_FUNCTION const constrained_dynamics_result& constrained_dynamics_under_kept(const runtime_chain& c,
                                                                                runtime_state& s) {
  refuse_contacts(c);
  auto& m = loops_of(c, s);
  const auto& at = m.equations.places;
  auto& r = m.result;
  if (!has_loops(c)) {
    r.a = accelerations_at_state(c, s), r.mobility = s.dofs();
    return r;
  }
  r.a = accelerations_on_loops(c, s, false);
  r.rank = m.factor.rank(), r.mobility = s.dofs() - r.rank, r.gap = widest_gap(m.equations).size;
  r.dependent = dependent_rows(closures_of(c), m.equations, m.factor);
  r.loops.resize(at.closures.size());
  for (std::size_t i = r.names.size(); i < r.loops.size(); ++i)
    r.names.push_back(closures_of(c).loop_name(at.closures[i].loop));
  for (std::size_t i = 0; i < r.loops.size(); ++i) {
    const auto& x = at.closures[i];
    r.loops[i] = s.get<kind::loop>(x.loop);
    for (int k = 0; k < x.rows.count(); ++k)
      row_of(r.loops[i].residual, r.loops[i].ang_residual, x.rows, k) =
          m.equations.residual[x.first + k] / at.scale(x, k);
  }
  return r;
}
KTE_FUNCTION const Eigen::VectorXd& velocities_on_loops(const runtime_chain& c, runtime_state& s) {
  Eigen::VectorXd v = read_numbers<vector_of::v>(s);
  if (has_loops(c)) {
    put_on_loops(closures_of(c), s, factorized_loops(c, s), v);
    check_velocities_on_loops(v);
    write_numbers<vector_of::v>(s, v, "v");
  }
  s.work.forces = v;
  return s.work.forces;
}
KTE_FUNCTION Eigen::MatrixXd loop_jacobian_at_state(const runtime_chain& c, runtime_state& s) {
  if (!has_loops(c)) return Eigen::MatrixXd(0, s.dofs());
  auto& m = loops_of(c, s);
  m.equations.at_positions(closures_of(c), s, true);
  check_residuals(closures_of(c), m.equations, true);
  return m.equations.dense_jacobian();
}
#endif

#ifdef KTE_FUNCTION
KTE_FUNCTION std::vector<std::string> dependent_rows(const chain_constraints& c, const loop_equations& e,
                                                     const loop_factor& factor) {
  std::vector<std::string> names;
  for (int k = 0; factor.rank() < e.places.rows && k < e.places.rows; ++k)
    if (!factor.is_chosen(e, k)) names.push_back(e.places.name_of_row(c, k));
  return names;
}
KTE_FUNCTION loops_report report_of(const chain_constraints& c, const loop_workspace& m, int dofs) {
  const auto& e = m.equations;
  const auto& factor = m.factor;
  loops_report r;
  r.rows = e.places.rows, r.rank = factor.rank(), r.mobility = dofs - r.rank;
  for (const auto& p : factor.parts)
    if (p.largest > 0) r.pivot_ratio = (std::min)(r.pivot_ratio, p.smallest / p.largest);
  const auto widest = widest_gap(e);
  r.gap = widest.size, r.widest = c.loop_name(widest.closure->loop);
  r.dependent = dependent_rows(c, e, factor);
  for (const auto& b : e.places.blocks) r.blocks.push_back(e.places.names_in(c, b, ""));
  return r;
}
KTE_FUNCTION void put_on_loops(const chain_constraints& c, runtime_state& s, loop_workspace& m, Eigen::VectorXd& v) {
  const auto& e = m.equations;
  Eigen::VectorXd by_given;
  m.equations.put_given_rates(c, s, by_given);
  for (int i = 0; i < 2; ++i) {
    m.factor.least_change(s, e, e.times(v) + by_given, m.change);
    v -= m.change;
  }
  const double moved = by_given.cwiseAbs().maxCoeff();
  if (!(moved > 0)) return;
  const Eigen::VectorXd left = e.times(v) + by_given;
  const double bound = 1e-8 * (e.times_sizes(v).maxCoeff() + moved);
  for (int k = 0; k < e.places.rows; ++k)
    if (!(std::abs(left[k]) <= bound)) [[unlikely]]
      raise<bad_argument>("kte: no velocities keep '" + c.loop_name(e.places.closure_of_row(k).loop) +
                          "' closed with the given motions, those of bases and of coordinates that signals move");
}
#endif

}  // namespace kte::detail
