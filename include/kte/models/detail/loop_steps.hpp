#pragma once

#include <kte/dynamics/closed_loops/loop_dynamics.hpp>
#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/state_vectors.hpp>

/// Steps of a model whose chain has loops. J_S, R are those of the independent rows chosen at the state x0 where a step
/// starts, and N = M^-1 J_S^T R^-1 (dynamics/closed_loops/loop_factor.hpp):
///
///   q(d) = q0 (+) (d_q + N mu),   g_S(q) = 0           (1)
///   v(d) = v0 + d_v + N nu,       J_S(q) v = 0         (2)
///   e <- e - N R^-T J_S e         of error estimates    (3)
///
/// The projection keeps the order of the method, by (3) (Eich, Convergence results for a coordinate projection method,
/// SIAM J. Numer. Anal. 30, 1993). Rows are chosen on the loops, because rows that are dependent there are independent
/// away from them.
namespace kte::detail {

/// A state is on the loops if residuals are below the first bound, and off the loops above the second, relative to the
/// size of the chain.
inline constexpr double on_loops_within = 1e-12, off_loops_above = 1e-8;

struct loop_step {
  Eigen::VectorXd x0;
  loop_equations equations;  ///< at x0
  loop_factor factor;
  double gap = 0;      ///< the largest residual
  double sliding = 0;  ///< the largest residual rate, relative to the largest that the rates of coordinates could cause
};

/// What is kept of the step from x0, or that.
template <class Model>
loop_step& step_from(const Model& model, runtime_state& s, own_memory& kept, const Eigen::VectorXd& x0) {
  auto& step = kept.template get<loop_step>([&] { return loop_step{{}, loop_equations(model.chain(), s), {}}; });
  if (step.x0.size() == x0.size() && step.x0 == x0) return step;
  step.x0.resize(0);
  model.setJointStates(x0, s);
  check_positions(s);
  auto& e = step.equations;
  e.at_positions(model.chain(), s, true);
  step.factor.choose(model.chain(), s, e, least_pivot_at(e.residual));
  step.gap = e.residual.cwiseAbs().maxCoeff();
  const Eigen::VectorXd v = model.velocities_of(x0);
  const Eigen::VectorXd rates = e.times(v), most = e.times_sizes(v);
  step.sliding = 0;
  for (Eigen::Index k = 0; k < rates.size(); ++k)
    if (most[k] > 0) step.sliding = (std::max)(step.sliding, std::abs(rates[k]) / most.maxCoeff());
  step.x0 = x0;
  return step;
}
inline std::string gap_text(const runtime_chain& c, const loop_equations& e) {
  const auto widest = widest_gap(e);
  return "'" + closure_places::name_of(c, *widest.closure) + "' is open by " + number(widest.size) +
         (widest.linear ? " m" : " rad");
}
/// With loops closed to rounding, branches can be distinguished if pivots are above the square root of rounding.
inline constexpr double least_pivot_of_branch = 1e-7;
/// Throws `bad_argument` where a step starts off the loops, or so near to a singular configuration that branches cannot
/// be told apart.
inline void check_step(const runtime_chain& c, const runtime_state&, loop_step& step) {
  if (step.gap > off_loops_above) [[unlikely]]
    throw bad_argument("kte: the state is off the loops: " + gap_text(c, step.equations) +
                       ": kte::assemble finds one that is on them");
  if (step.sliding > 1e-6) [[unlikely]]
    throw bad_argument(
        "kte: the velocities do not keep the loops closed: kte::consistent_velocities, or after an impact "
        "kte::impulse, gives such as do");
  for (const auto& p : step.factor.parts)
    if (p.smallest < least_pivot_of_branch * p.largest) [[unlikely]]
      throw bad_argument(
          "kte: the loops are as near to a singular configuration as rounding, where the mechanism may go on "
          "in several ways: larger tolerances pass it in one step");
}

/// (1) and (2).
template <class Model>
void settle_on_loops(const Model& model, runtime_state& s, loop_step& step, Eigen::VectorXd& d, Eigen::VectorXd& x) {
  const runtime_chain& c = model.chain();
  const int n = model.dofs();
  auto& memory = loops_of(c, s);
  auto& e = memory.equations;
  auto& factor = memory.factor;
  const loop_factor* by = &step.factor;
  const auto evaluate = [&](bool with_jacobian) {
    set_positions(s, model.positions_of(x));
    e.at_positions(c, s, with_jacobian);
    return step.factor.chosen_of(step.equations, e.residual).cwiseAbs().maxCoeff();
  };
  const auto move = [&](int first, const Eigen::VectorXd& change) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(d.size());
    r.segment(first, n) = change;
    if (first == 0) model.pull_back(d, r);
    d -= r;
    model.displace(step.x0, d, x);
  };
  double gap = evaluate(false), last = std::numeric_limits<double>::infinity();
  for (int i = 0; gap > 1e-16; ++i) {
    if (!(gap < 1e300) || i == 20)
      throw bad_argument("kte: the loops do not close at the end of a step: " + gap_text(c, e) + ": a shorter step");
    if (gap > last / 20) {  // the factor of the start is no longer good, or the rest is rounding
      if (gap <= on_loops_within && by == &factor) break;
      (void)evaluate(true);
      if (factor.keep(c, s, e, step.factor, 1e-14)) by = &factor;
    }
    move(0, by->least_change(step.equations, e.residual));
    last = gap, gap = evaluate(false);
  }
  (void)evaluate(true);
  if (const double open = e.residual.cwiseAbs().maxCoeff(); !(open <= 1e-10)) [[unlikely]]
    throw bad_argument("kte: the closures contradict each other: " + gap_text(c, e) + " where others are closed");
  if (!factor.keep(c, s, e, step.factor, 1e-14)) factor.choose(c, s, e, least_pivot);
  for (int i = 0; i < 2; ++i) move(n, factor.least_change(e, e.times(model.velocities_of(x))));
}
/// (3) of positions and velocities.
inline void make_tangential(const loop_step& step, Eigen::VectorXd& e) {
  const auto n = static_cast<Eigen::Index>(step.equations.places.row_of_place.size());
  for (const Eigen::Index first : {Eigen::Index(0), n}) {
    const Eigen::VectorXd part = e.segment(first, n);
    e.segment(first, n) -= step.factor.least_change(step.equations, step.equations.times(part));
  }
}
/// Accelerations under no forces from outside, at a stage of a step: by the rows of its start, unless the state is on
/// the loops.
inline const Eigen::VectorXd& accelerations_in_step(const runtime_chain& c, runtime_state& s, own_memory& kept) {
  check_regular_tree(c, s), check_positions(s);
  auto& e = loops_of(c, s).equations;
  e.at_positions(c, s, false);
  const auto none = [](int) { return 0.0; };
  const bool off = e.residual.cwiseAbs().maxCoeff() > on_loops_within;
  auto* step = off ? kept.find<loop_step>() : nullptr;
  return constrained_accelerations(c, s, none, step && step->x0.size() > 0 ? &step->factor : nullptr);
}

/// x, put on the loops to rounding. Throws `bad_argument` where it is off them.
template <class Model>
Eigen::VectorXd checked_on_loops(const Model& model, const Eigen::VectorXd& x) {
  if (!has_loops(model.chain())) return x;
  model.begin_step(x);
  return model.on_loops(x);
}

}  // namespace kte::detail
