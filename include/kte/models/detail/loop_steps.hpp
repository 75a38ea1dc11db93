#pragma once

#include <kte/dynamics/closed_loops/given_motion.hpp>
#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include <utility>

/// Steps of a model whose chain has loops. J_S and R belong to the independent rows selected at the state x0 where a
/// step begins, and N = M^-1 J_S^T R^-1 (dynamics/closed_loops/loop_factor.hpp):
///
///   q(d) = q0 (+) (d_q + N mu),   g_S(q) = 0           (1)
///   v(d) = v0 + d_v + N nu,       J_S(q) v + g_S' = 0  (2)
///   e <- e - N R^-T J_S e         for error estimates   (3)
///
/// With (3) the projection keeps the order of the method (Eich, Convergence results for a coordinate projection method,
/// SIAM J. Numer. Anal. 30, 1993). Rows are selected on the loops, because rows that are dependent there are
/// independent away from them. g and its rate g' by given motions are those at the time of the state: signals that are
/// functions of time may move coordinates and frames.
namespace kte::detail {

/// A state is on the loops if residuals are below the first bound, and off the loops above the second, relative to the
/// size of the chain.
inline constexpr double on_loops_within = 1e-12, off_loops_above = 1e-8;

struct loop_step {
  loop_step(const chain_constraints& c, const runtime_state& s) : equations(c, s), moved_by(given_motion_of(c)) {}
  bool is_moved() const { return moved_by != given_motion::none; }

  Eigen::VectorXd x0;
  loop_equations equations;  ///< at x0
  loop_factor factor;
  given_motion moved_by;
  double time = 0;              ///< of the states that are put on the loops
  Eigen::VectorXd given_rates;  ///< g' of the last state
  double gap = 0;               ///< the largest residual
  double rounding = 0;          ///< of its residuals
  double sliding = 0;           ///< the largest residual rate, relative to the largest terms of J v
  double nearest = 1;           ///< the smallest pivot of its stages, relative to that of x0
  double nearest_at_end = 1;    ///< that of the stages of the last attempt
};

/// The loops of a model, with the model's memory.
struct runtime_model_loops {
  const manipulator_dynamics_model<runtime_chain>& model;
  runtime_state& s;
  own_memory& kept;

  chain_constraints closures() const { return closures_of(model.chain()); }
  bool inputs_move() const { return model.inputs_move(); }
  runtime_state& state() const { return s; }
  loop_workspace& workspace() const { return loops_of(model.chain(), s); }
  loop_step& step() const {
    return kept.get<loop_step>([&] { return loop_step(closures(), s); });
  }
  /// Writes x to the state, with the signals at the time of the step.
  void put(const Eigen::VectorXd& x) const { model.setJointStates(step().time, x, s), check_positions(s); }
  void put_positions(const Eigen::VectorXd& x) const {
    if (step().is_moved()) return put(x);
    set_positions(s, model.positions_of(x));
  }
};

/// The row of closures with the largest rate J v + g', this rate by scaled rows, and relative to its largest terms.
struct row_rate {
  Eigen::Index row = 0;
  double rate = 0, relative = 0;
};
inline row_rate fastest_row(const loop_equations& e, const Eigen::VectorXd& v, const Eigen::VectorXd& given_rates) {
  row_rate r;
  r.rate = (e.times(v) + given_rates).cwiseAbs().maxCoeff(&r.row);
  if (!(r.rate > 0)) return r;
  // the terms of J v may all be rounding errors, where bodies move along the loops, and all of J where its rank is 0
  const double speed = v.cwiseAbs().maxCoeff();
  const double fastest = e.times_sizes(Eigen::VectorXd::Constant(v.size(), speed)).maxCoeff();
  const double terms = e.times_sizes(v).maxCoeff() + given_rates.cwiseAbs().maxCoeff();
  r.relative = r.rate / (terms + 1e-7 * fastest + 1e-9 * speed);
  return r;
}
/// Writes the rates of closures by given motions at the state to the data of a step.
inline void put_given_rates(const runtime_model_loops& loops, loop_step& step, loop_equations& e) {
  if (step.is_moved())
    e.put_given_rates(loops.closures(), loops.state(), step.given_rates);
  else
    step.given_rates.setZero(e.places.rows);
}
/// Above this rate, relative to the largest terms of J v, velocities do not keep the loops closed.
inline constexpr double opening_above = 1e-6;
/// The data of the step from x0; begins the step if necessary.
inline loop_step& step_from(const runtime_model_loops& loops, const Eigen::VectorXd& x0) {
  auto& step = loops.step();
  if (step.x0.size() == x0.size() && step.x0 == x0) return step;
  step.x0.resize(0);
  loops.put(x0);
  check_finite(loops.model.velocities_of(x0), static_cast<std::size_t>(loops.model.velocity_count()),
               "kte: a velocity is not finite");
  auto& e = step.equations;
  e.at_positions(loops.closures(), loops.state(), true);
  choose_rows(loops.closures(), loops.state(), e, step.factor);
  step.gap = e.residual.cwiseAbs().maxCoeff();
  step.rounding = e.rounding(loops.state(), x0);
  const Eigen::VectorXd v = loops.model.velocities_of(x0);
  put_given_rates(loops, step, e);
  step.sliding = fastest_row(e, v, step.given_rates).relative;
  step.x0 = x0;
  return step;
}
/// The closures of a block, or of all, for messages.
inline std::string names_of_loops(const chain_constraints& c, const loop_equations& e, std::size_t block) {
  return "the loops of " + e.places.names_in(c, e.places.blocks[block], "'", 3);
}
inline std::string names_of_loops(const chain_constraints& c, const loop_equations& e) {
  return e.places.blocks.size() == 1 ? names_of_loops(c, e, 0) : "the loops";
}
/// Raises `bad_argument`, naming a closure, if inputs move its frames at velocities other than zero: the positions that
/// they give are constant.
inline void refuse_moving_inputs(const chain_constraints& c, const loop_step& step) {
  const auto& at = step.equations.places;
  for (int k = 0; k < at.rows; ++k) {
    const auto& x = at.closure_of_row(k);
    if (const double rate = std::abs(step.given_rates[k]); !(rate <= 1e-12)) [[unlikely]]
      raise<bad_argument>("kte: inputs give a velocity to a frame of '" + c.loop_name(x.loop) + "', which opens at " +
                          number(rate / at.scale(x, k - x.first)) + (k - x.first < x.rows.linear ? " m/s" : " rad/s") +
                          ", but inputs are constant in a step: set these velocities to zero, or let functions of "
                          "kte::chain_time (law_signal) give the motion");
  }
}
/// With loops closed to rounding, branches can be distinguished if pivots are above the square root of rounding.
inline constexpr double least_pivot_of_branch = 1e-7;
/// Throws `bad_argument` if a step begins off the loops, or so near to a singular configuration that branches cannot be
/// distinguished.
inline void check_step(const runtime_model_loops& loops, const Eigen::VectorXd& x0) {
  if (loops.step().is_moved()) loops.step().x0.resize(0);  // the time or inputs may have changed
  auto& step = step_from(loops, x0);
  step.nearest = 1;
  if (step.moved_by == given_motion::inputs && !loops.inputs_move()) [[unlikely]]
    refuse_moving_inputs(loops.closures(), step);
  if (step.gap > (std::max)(off_loops_above, step.rounding)) [[unlikely]]
    raise<bad_argument>("kte: the state is off the loops: " + gap_text(loops.closures(), step.equations) +
                        ": kte::assemble finds one that is on them");
  if (step.sliding > opening_above) [[unlikely]]
    raise<bad_argument>(
        "kte: the velocities do not keep the loops closed: use kte::consistent_velocities, or "
        "kte::impulse after an impact");
  for (std::size_t i = 0; i < step.factor.parts.size(); ++i)
    if (const auto& p = step.factor.parts[i]; p.smallest < least_pivot_of_branch * p.largest) [[unlikely]]
      raise<bad_argument>("kte: " + names_of_loops(loops.closures(), step.equations, i) +
                          " are as near to a singular configuration as rounding, where the mechanism may go on in "
                          "several ways: larger tolerances pass it in one step");
}
/// The smallest pivot where a step begins, relative to its possible size.
inline double smallest_pivot_of(const loop_step& step) {
  double d = 1;
  for (std::size_t i = 0; i < step.factor.parts.size(); ++i)
    d = (std::min)(d, step.factor.smallest_pivot(step.equations, i));
  return d;
}
inline double singular_distance_of(const runtime_model_loops& loops, const Eigen::VectorXd& x0) {
  return smallest_pivot_of(step_from(loops, x0));
}
/// Notes how near a stage of a step is to a singular configuration, after its accelerations.
inline void note_stage(const runtime_model_loops& loops) {
  auto& step = loops.step();
  if (step.x0.size() == 0) return;
  const auto& stage = loops.workspace();
  for (std::size_t i = 0; i < stage.factor.parts.size(); ++i)
    step.nearest = (std::min)(
        step.nearest, stage.factor.smallest_pivot(stage.equations, i) / step.factor.smallest_pivot(step.equations, i));
}
/// Raises `bad_argument` if a step from x0 ends much nearer to a singular configuration than it began, where velocities
/// would have errors of eps over the pivot. A shorter step ends before the singular configuration, and the next step
/// passes it. From a state nearer than this, rounding errors above a small tolerance would force ever shorter steps,
/// which end at the singular configuration. Steps that are themselves short may end anywhere. Also if a stage was
/// there: off the loops by e, with a pivot of the size of e, it has wrong directions of closure forces, and the error
/// estimate does not see all stages.
inline void check_step_end(const runtime_model_loops& loops, const Eigen::VectorXd& x0) {
  constexpr double near_it = 1e-2, nearer = 0.1, nearest_stage = 3e-3;
  auto& start = step_from(loops, x0);
  start.nearest_at_end = std::exchange(start.nearest, 1);
  if (start.nearest_at_end < nearest_stage) [[unlikely]]
    raise<bad_argument>("kte: a stage of the step is too near to a singular configuration of " +
                        names_of_loops(loops.closures(), start.equations) + ": a shorter step");
  const auto& end = loops.workspace();
  for (std::size_t i = 0; i < end.factor.parts.size(); ++i) {
    const double pivot = end.factor.smallest_pivot(end.equations, i);
    if (pivot < near_it && pivot < nearer * start.factor.smallest_pivot(start.equations, i)) [[unlikely]]
      raise<bad_argument>("kte: the step ends too near to a singular configuration of " +
                          names_of_loops(loops.closures(), start.equations, i) + ": a shorter step");
  }
}

/// Subtracts `change`, of the numbers from `first` on, from the displacement d of x = x0 (+) d.
inline void take_from_displacement(const manipulator_dynamics_model<runtime_chain>& model, const Eigen::VectorXd& x0,
                                   Eigen::Index first, const Eigen::VectorXd& change, Eigen::VectorXd& d,
                                   Eigen::VectorXd& x) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(d.size());
  r.segment(first, change.size()) = change;
  if (first == 0) model.pull_back(d, r);
  d -= r;
  model.displace(x0, d, x);
}
/// Raises `bad_argument` if a step ends on another branch than it began, as a long step may that passes a singular
/// configuration: its velocities v at the end are far from directions along the loops at its start.
inline void check_branch(const runtime_model_loops& loops, loop_step& step, const Eigen::VectorXd& v) {
  constexpr double turn = 0.8, slow = 1e-6;
  if (step.sliding > opening_above || !(v.norm() > slow)) return;  // the start itself is not on the loops, or at rest
  const Eigen::VectorXd across =
      step.factor.least_change(loops.state(), step.equations, step.equations.times(v) + step.given_rates);
  if (across.norm() > turn * v.norm()) [[unlikely]]
    raise<bad_argument>("kte: the step ends on another branch of " + names_of_loops(loops.closures(), step.equations) +
                        ", or turns too far: a shorter step");
}
/// (1) and (2).
inline void settle_on_loops(const runtime_model_loops& loops, const Eigen::VectorXd& x0, Eigen::VectorXd& d,
                            Eigen::VectorXd& x) {
  auto& step = step_from(loops, x0);
  const auto& model = loops.model;
  const int n = model.velocity_count();
  auto& s = loops.state();
  auto& memory = loops.workspace();
  auto& e = memory.equations;
  auto& factor = memory.factor;
  const auto closures = loops.closures();
  loop_factor* by = &step.factor;
  const auto evaluate = [&](bool with_jacobian) {
    loops.put_positions(x);
    e.at_positions(closures, s, with_jacobian);
    return step.factor.largest_of_chosen(step.equations, e.residual);
  };
  const auto move = [&](int first, const Eigen::VectorXd& change) {
    take_from_displacement(model, x0, first, change, d, x);
  };
  double gap = evaluate(false), last = std::numeric_limits<double>::infinity();
  for (int i = 0; gap > 1e-16; ++i) {
    if (!(gap < 1e300) || i == 20)
      raise<bad_argument>("kte: the loops do not close at the end of a step: " + gap_text(closures, e) +
                          ": a shorter step");
    if (gap > last / 20) {  // the factor of the start is not accurate enough, or only rounding errors are left
      if (gap <= (std::max)(on_loops_within, step.rounding) && by == &factor) break;
      (void)evaluate(true);
      factor.factorize(closures, s, e);
      if (factor.keep(closures, s, e, step.factor, 1e-14)) by = &factor;
    }
    move(0, by->least_change(s, step.equations, e.residual));
    last = gap, gap = evaluate(false);
  }
  (void)evaluate(true);
  if (const double open = e.residual.cwiseAbs().maxCoeff(); !(open <= (std::max)(1e-10, step.rounding))) [[unlikely]]
    raise<bad_argument>("kte: the closures contradict each other, or the step is too long: " + gap_text(closures, e) +
                        " where others are closed");
  factor.factorize(closures, s, e);
  if (!factor.keep(closures, s, e, step.factor, 1e-14)) factor.choose(closures, s, e, least_pivot);
  put_given_rates(loops, step, e);
  for (int i = 0; i < 2; ++i) move(n, factor.least_change(s, e, e.times(model.velocities_of(x)) + step.given_rates));
  check_branch(loops, step, model.velocities_of(x));
  if (factor.rank() == e.places.rows) return;
  if (const auto r = fastest_row(e, model.velocities_of(x), step.given_rates); r.relative > opening_above)
      [[unlikely]] {
    const auto& closure = e.places.closure_of_row(static_cast<int>(r.row));
    const int k = static_cast<int>(r.row) - closure.first;
    raise<bad_argument>("kte: the closures contradict each other, or the step is too long: '" +
                        closures.loop_name(closure.loop) + "' opens by " + number(r.rate / e.places.scale(closure, k)) +
                        (k < closure.rows.linear ? " m/s" : " rad/s") + " where others stay closed");
  }
}
/// (3), for positions and velocities. Velocities of stages have rounding errors of about
///
///   r = 4 sqrt(rows) eps |v| / (smallest pivot),          (4)
///
/// which no shorter step makes smaller. They do not count as errors of a step that passes a singular configuration:
/// otherwise small tolerances would force ever shorter steps towards it, where these errors grow without bound.
inline void make_tangential(const runtime_model_loops& loops, const Eigen::VectorXd& x0, Eigen::VectorXd& e) {
  auto& step = step_from(loops, x0);
  const Eigen::Index n = loops.model.velocity_count();
  for (const Eigen::Index first : {Eigen::Index(0), n}) {
    const Eigen::VectorXd part = e.segment(first, n);
    e.segment(first, n) -= step.factor.least_change(loops.state(), step.equations, step.equations.times(part));
  }
  if (step.nearest_at_end > 0.5) return;  // far from singular configurations, where (4) would hide stiffness
  const double rounding = 4 * std::sqrt(step.equations.places.rows) * std::numeric_limits<double>::epsilon();
  const double pivot = step.nearest_at_end * smallest_pivot_of(step);
  const double size = e.segment(n, n).norm(), least = rounding * loops.model.velocities_of(x0).norm() / pivot;  // (4)
  if (size > 0) e.segment(n, n) *= (std::max)(0.0, 1 - least / size);
}
/// The rows for a stage of a step at the state: those selected at its start, unless the state is on the loops.
inline const loop_factor* rows_of_stage(const runtime_model_loops& loops) {
  auto& e = loops.workspace().equations;
  e.at_positions(loops.closures(), loops.state(), false);
  if (!(e.residual.cwiseAbs().maxCoeff() > on_loops_within)) return nullptr;
  const auto& step = loops.step();
  return step.x0.size() > 0 ? &step.factor : nullptr;
}
/// Raises `bad_argument` for what the loops of a model, with or without contacts, do not support.
inline void check_model_of_loops(const chain_constraints& c, const runtime_state& s, const closure_places& places,
                                 bool with_contacts) {
  check_loops(c, s), refuse_given_motion(c, s, places, moved_by_measurements(c), "by measurements");
  if (with_contacts) refuse_given_motion(c, s, places, moved_by_time(c), "in time, in a chain with contacts");
}
/// x projected onto the loops to rounding. Throws `bad_argument` if it is off them.
inline Eigen::VectorXd checked_on_loops(const manipulator_dynamics_model<runtime_chain>& model,
                                        const Eigen::VectorXd& x) {
  if (!model.has_loops()) return x;
  model.begin_step(x);
  return model.on_loops(x);
}

}  // namespace kte::detail
