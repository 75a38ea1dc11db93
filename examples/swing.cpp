/// An arm let go: the KUKA iiwa14 swings freely for a second, by several integrators, as a static and as a runtime
/// chain, against a reference of 27 digits; then for a minute, with its tool recorded in swing.csv (for PlotJuggler)
/// and swing.mcap (for Foxglove), the times at which the tool passes the height of the shoulder found as events, and
/// its energy watched.
#include <kte/dynamics/energy.hpp>
#include <kte/events/events.hpp>
#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/io.hpp>
#include <kte/kte.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/models/variational.hpp>
#include <kte/models/vector_form.hpp>

#include <cstdio>
#include <ctime>

#include "data/problems/iiwa14_free_swing.hpp"

using problem = kte::problems::iiwa14_free_swing;
using robots::iiwa14_names::tool;

const kte::manipulator_dynamics_model arm(robots::iiwa14);
using joints = kte::joint_vector<double, 7>;

/// The error of the tool's position after a second, m, and what it took.
template <class Solver>
void line(const char* chain, const char* name, Solver solver) {
  const std::clock_t start = std::clock();
  solver.integrate(1);
  const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const joints q = solver.state().head(7), v = solver.state().tail(7);
  const auto x = problem::output<double>(q, v);
  double error = 0;
  for (int i = 14; i < 17; ++i)
    error = std::max(error, std::abs(x[i] - static_cast<double>(problem::references[0].values[i])));
  std::printf("  %-8s %-24s %12lld %10.2f %12.1e\n", chain, name, solver.statistics().evaluations, ms, error);
}

template <class Model, class X>
void lines(const char* chain, Model& model, const X& x0) {
  const auto f = std::ref(model);
  const kte::tolerances<double> crude{.absolute = 1e-6, .relative = 1e-6}, fine{.absolute = 1e-11, .relative = 1e-11};
  line(chain, "runge_kutta4 1 ms", kte::runge_kutta4(f, 0.0, x0, 1e-3));
  line(chain, "dormand_prince45 1e-6", kte::dormand_prince45(f, 0.0, x0, crude));
  line(chain, "dormand_prince45 1e-11", kte::dormand_prince45(f, 0.0, x0, fine));
  line(chain, "prince_dormand87 1e-6", kte::prince_dormand87(f, 0.0, x0, crude));
  line(chain, "prince_dormand87 1e-11", kte::prince_dormand87(f, 0.0, x0, fine));
  line(chain, "adams 1e-11", kte::adams(kte::vector_form(f), 0.0, x0, fine));
}

double energy_of(const Eigen::Matrix<double, 14, 1>& x) {
  const auto e = kte::energy(robots::iiwa14, arm.positions_of(x).eval(), arm.velocities_of(x).eval());
  return e.kinetic + e.potential;
}

int main() {
  const auto x0 = arm.make_x(problem::start_q<double>(), problem::start_v<double>());
  std::printf("KUKA iiwa14, let go, after 1 s:\n  %-8s %-24s %12s %10s %12s\n", "chain", "integrator", "evaluations",
              "CPU ms", "error, m");
  lines("static", arm, x0);
  line("static", "variational4 1 ms", kte::variational4(std::cref(arm), 0.0, x0, 1e-3));
  kte::manipulator_dynamics_model runtime(kte::to_chain(kte::record_of(robots::iiwa14)));
  lines("runtime", runtime, Eigen::VectorXd(x0));

  constexpr double duration = 60;
  kte::recorder csv("swing.csv", robots::iiwa14, {"tool/position", "tool/rotation"});
  kte::recorder mcap("swing.mcap", robots::iiwa14, {"tool/position", "tool/rotation"});
  kte::progress report(0, duration, kte::progress_bar());
  const auto shoulder = kte::event([](double, const auto& x) {
    return kte::forward_kinematics(robots::iiwa14, arm.positions_of(x).eval(), tool).position.z - 0.36;
  });
  double drift = 0;
  kte::dormand_prince45 solver(std::cref(arm), 0.0, x0, {.absolute = 1e-10, .relative = 1e-10});
  const auto events =
      kte::integrate(solver, duration, kte::events(shoulder), kte::every(0.01), [&](double t, const auto& x) {
        const auto s = arm.state_at(t, x);
        csv.row(t, s), mcap.row(t, s);
        drift = std::max(drift, std::abs(energy_of(x) - energy_of(x0)));
        report(t);
      });
  csv.close(), mcap.close();
  std::printf("\nFor %g s: swing.csv and swing.mcap have its tool every 0.01 s.\n", duration);
  std::printf("It passed the height of the shoulder %lld times, first at %.9f s; energy stayed within %.1e J.\n",
              events.count, events.events.at(0).time, drift);
}
