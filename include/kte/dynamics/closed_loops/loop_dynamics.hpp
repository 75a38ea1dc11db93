#pragma once

#include <kte/dynamics/closed_loops/loop_factor.hpp>
#include <kte/dynamics/closed_loops/loop_results.hpp>
#include <kte/dynamics/runtime/accelerations.hpp>

/// Accelerations and closure forces of a chain with loops, in the working memory of a state.
namespace kte::detail {

/// Pivots below this fraction of the first count as zero when rows are selected.
inline constexpr double least_pivot = 1e-10;

/// Loops that are open by more than this, m relative to the length of the chain or rad, are not assembled.
inline constexpr double unassembled_above = 1e-2;

/// The equations of the closures of a chain, their factor, and quantities derived from both.
struct loop_workspace {
  loop_workspace(const chain_constraints& c, const runtime_state& s) : equations(c, s) {}
  loop_equations equations;
  loop_factor factor;
  Eigen::VectorXd change, multipliers;
};
/// The memory of a runtime state for the loops of its chain.
struct loop_memory_of_state : loop_workspace {
  std::shared_ptr<const char> layout;
  constrained_dynamics_result result;
  own_memory derivatives;
  loop_memory_of_state(const chain_constraints& c, const runtime_state& s) : loop_workspace(c, s), layout(c.layout()) {}
};
loop_memory_of_state& loops_of(const runtime_chain& c, runtime_state& s);

/// Raises `bad_argument` for elements that chains with loops do not support.
template <class State>
void check_loops(const chain_constraints& c, const State& s) {
  const auto refuse = [&c](int e, const char* why) { raise<bad_argument>("kte: " + c.describe(e) + why); };
  if (!s.tree().locks.empty()) [[unlikely]]
    refuse(s.tree().locks.front(), " may lock a coordinate, which chains with closures do not know");
  if (!s.tree().readers.empty()) [[unlikely]]
    refuse(s.tree().readers.front(), " has load-dependent friction, which chains with closures do not know");
}
/// Raises `bad_argument`, naming the closure, unless residuals are finite; with J also its entries.
void check_residuals(const chain_constraints& c, const loop_equations& e, bool with_jacobian);
/// Raises `bad_argument`, naming the closure with the largest gap, for forward dynamics of loops that are not
/// assembled.
inline constexpr const char* assemble_first =
    ": kte::assemble closes the loops, and kte::constrained_dynamics supports open ones";
inline void refuse_unassembled(const chain_constraints& c, const loop_equations& e) {
  if (!(e.residual.cwiseAbs().maxCoeff() > unassembled_above)) [[likely]]
    return;
  raise<bad_argument>("kte: forward_dynamics: " + gap_text(c, e) + assemble_first);
}
/// The pivot that counts as zero for residuals that are not zero: rows that are dependent on the loops are independent
/// away from them, in proportion to the distance.
inline double least_pivot_at(const Eigen::VectorXd& residual) {
  const double gap = residual.size() > 0 ? residual.cwiseAbs().maxCoeff() : 0;
  return gap < 1e-8 ? (std::max)(least_pivot, 100 * gap) : least_pivot;
}
/// Computes J_dot v at the state and selects rows there; call `at_positions` with J first.
inline void choose_rows(const chain_constraints& c, runtime_state& s, loop_equations& e, loop_factor& factor) {
  factor.factorize(c, s, e);
  factor.choose(c, s, e, least_pivot_at(e.residual));
}
/// Computes residuals and J, and selects rows, at the positions of the state.
inline void factorize_loops(const chain_constraints& c, runtime_state& s, loop_workspace& m) {
  m.equations.at_positions(c, s, true);
  check_residuals(c, m.equations, true);
  choose_rows(c, s, m.equations, m.factor);
}
void put_loop_forces(const closure_places& at, const Eigen::VectorXd& multipliers, runtime_state& s);

/// Accelerations under applied(i), written to `forces` of the working memory, with the closure forces:
///
///   a = a0 - d(J_dot v + J a0),   lambda = -multipliers(J_dot v + J a0)          (1)
///
/// a0: accelerations of the tree; J a0 of trees is a sum on the way inward, and a is computed once. The rows are those
/// of `rows`; if there are none, or they are dependent, rows are selected here.
void accelerate_on_loops(const chain_constraints& c, runtime_state& s, loop_workspace& m,
                         const tree::given_forces<double>& applied, const loop_factor* rows = nullptr);
/// `accelerate_on_loops` with the results in a runtime state. `assembled`: refuses loops that are not assembled.
const Eigen::VectorXd& constrained_accelerations(const runtime_chain& c, runtime_state& s,
                                                 const tree::given_forces<double>& applied,
                                                 const loop_factor* rows = nullptr, bool assembled = false);

#ifdef KTE_FUNCTION
KTE_FUNCTION const Eigen::VectorXd& constrained_accelerations(const runtime_chain& c, runtime_state& s,
                                                              const tree::given_forces<double>& applied,
                                                              const loop_factor* rows, bool assembled) {
  auto& m = loops_of(c, s);
  accelerate_on_loops(closures_of(c), s, m, applied, rows);
  if (assembled) refuse_unassembled(closures_of(c), m.equations);
  check_result(s, diagnose_state{"an acceleration", s});
  write_numbers<vector_of::a>(s, s.work.forces, "a");
  return s.work.forces;
}
KTE_FUNCTION const Eigen::VectorXd& kept_accelerations_on_loops(const runtime_chain& c, runtime_state& s,
                                                                bool assembled) {
  return constrained_accelerations(c, s, tree::given_forces(s.work.kept.data()), nullptr, assembled);
}
#endif
#ifndef KTE_EXTERN
inline const bool loops_are_known = (accelerations_on_loops = kept_accelerations_on_loops, true);
#endif

#ifdef KTE_FUNCTION
KTE_FUNCTION loop_memory_of_state& loops_of(const runtime_chain& c, runtime_state& s) {
  const auto make = [&] { return loop_memory_of_state(closures_of(c), s); };
  auto& m = s.loops.get<loop_memory_of_state>(make);
  if (m.layout != c.wiring().layout) m = make();
  return m;
}
KTE_FUNCTION void check_residuals(const chain_constraints& c, const loop_equations& e, bool with_jacobian) {
  const auto is_finite = [](const auto& x) { return x.cwiseAbs().sum() < std::numeric_limits<double>::infinity(); };
  const auto refuse = [&](int row, const char* what) {
    raise<bad_argument>("kte: closure '" + c.loop_name(e.places.closure_of_row(row).loop) + "': " + what +
                        " is not finite at this configuration");
  };
  for (int row = 0; row < e.places.rows && !is_finite(e.residual); ++row)
    if (const double g = e.residual[row]; g - g != 0) refuse(row, "its residual");
  for (std::size_t i = 0; with_jacobian && i < e.jacobian.size(); ++i)
    for (Eigen::Index k = 0; k < e.jacobian[i].rows() && !is_finite(e.jacobian[i]); ++k)
      if (!is_finite(e.jacobian[i].row(k)))
        refuse(e.places.row_of(e.places.blocks[i], static_cast<int>(k)), "a derivative of its residual");
}
KTE_FUNCTION void put_loop_forces(const closure_places& at, const Eigen::VectorXd& multipliers, runtime_state& s) {
  for (const auto& x : at.closures) {
    auto& loop = s.get<kind::loop>(x.loop);
    for (int r = 0; r < x.rows.count(); ++r)
      row_of(loop.force, loop.torque, x.rows, r) = at.scale(x, r) * multipliers[x.first + r];
  }
}
KTE_FUNCTION void accelerate_on_loops(const chain_constraints& c, runtime_state& s, loop_workspace& m,
                                      const tree::given_forces<double>& applied, const loop_factor* rows) {
  check_loops(c, s);
  auto& e = m.equations;
  auto& factor = m.factor;
  auto &change = m.change, &multipliers = m.multipliers;
  const auto rows_at_state = [&]<bool Accelerate>(std::bool_constant<Accelerate>) {
    if (!rows || !factor.keep<Accelerate>(c, s, e, *rows, least_pivot))
      factor.choose<Accelerate>(c, s, e, least_pivot_at(e.residual));
  };
  if (s.tree().plan.tree) {
    const auto biases = articulate_under(c.elements(), s, applied, {});
    e.at_positions(c, s, false, true);
    check_residuals(c, e, false);
    factor.take_articulated(s, e);
    rows_at_state(std::true_type{});
    factor.subtract_change(s, e, e.acceleration, multipliers);
    accelerate_after(s, biases);
  } else {
    accelerations_on_coordinates(c.elements(), s, applied, {});
    e.at_positions(c, s, true);
    check_residuals(c, e, true);
    auto& a = s.work.forces;
    change = a;
    for_each_listed_freedom(s, [&change = change](auto& x, const freedom& at) { put<vector_of::a>(x, at, change); });
    factor.factorize(c, s, e);
    e.at_rates(c, s);
    e.acceleration += e.times(change);
    a = change;
    rows_at_state(std::false_type{});
    factor.least_change(s, e, e.acceleration, change, multipliers);
    a -= change;
  }
  multipliers = -multipliers;
  put_loop_forces(e.places, multipliers, s);
}
#endif

}  // namespace kte::detail
