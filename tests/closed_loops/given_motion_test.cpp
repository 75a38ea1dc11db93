#include <kte/elements/law_signal.hpp>
#include <kte/integrators/adams.hpp>
#include <kte/integrators/bdf.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/models/vector_form.hpp>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"

// Loops through joints and bases that signals move.

namespace given_motion_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using model = manipulator_dynamics_model<runtime_chain>;

double largest(const vector& x) { return x.cwiseAbs().maxCoeff(); }

/// A bar on a pivot, whose tip is in a slot along y that a carriage moves: cos q = p. By a joint, or by a base.
runtime_chain slotted_bar(bool by_joint) {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "arm") << inertia_2D("arm", bar) << rigid_link_2D("arm", "tip", along_x(1.0));
  if (by_joint)
    c << position_control_gen("p", "v", "a", "x") << prismatic_joint_2D("x", "base", "moved", axis::x);
  else
    c << base_2D("ground") << position_control_2D("p", "v", "a", "ground", "moved");
  c << point_on_line_2D("slot", "moved", "tip", axis::y);
  return c;
}
void give(runtime_state& s, bool by_joint, double p, double v, double a) {
  if (by_joint)
    s.input("p") = p, s.input("v") = v, s.input("a") = a;
  else
    s.vector("p") = {p, 0, 0}, s.vector("v") = {v, 0, 0}, s.vector("a") = {a, 0, 0};
}

/// The parallelogram of `four_bars(1)`, whose first bar signals turn.
runtime_chain driven_parallelogram() {
  runtime_chain c;
  c << position_control_gen("p", "v", "a", "q0") << four_bars(1);
  return c;
}

/// A pendulum of 1 kg and 1 m in Cartesian coordinates, on a pivot that moves by X = 0.3 sin 2 t along x:
///
///   theta'' = -g sin theta - X'' cos theta
runtime_chain driven_pendulum() {
  using std::cos;
  using std::sin;
  runtime_chain c;
  c.gravity(along_y(-9.81)) << law_signal([](const auto& t) { return 0.3 * sin(2.0 * t); }, "time", "p")
                            << law_signal([](const auto& t) { return 0.6 * cos(2.0 * t); }, "time", "v")
                            << law_signal([](const auto& t) { return -1.2 * sin(2.0 * t); }, "time", "a")
                            << position_control_gen("p", "v", "a", "pivot")
                            << prismatic_joint_2D("pivot", "base", "hook", axis::x)
                            << prismatic_joint_2D("x", "base", "a", axis::x)
                            << prismatic_joint_2D("y", "a", "b", axis::y) << inertia_2D("b", point_mass(1.0))
                            << distance_2D("rod", "hook", "b", 1.0);
  return c;
}
vector bob_at(double angle) { return numbers({std::sin(angle), -std::cos(angle)}); }
/// The position and velocity of the bob at t, from rest in the axes of the pivot at the angle 1.
vector bob_of_pendulum(double t) {
  const auto f = [](double time, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x[1], -9.81 * std::sin(x[0]) + 1.2 * std::sin(2 * time) * std::cos(x[0]));
  };
  prince_dormand87 solver(f, 0.0, Eigen::Vector2d(1, 0), {.absolute = 1e-14, .relative = 1e-14});
  solver.integrate(t);
  const double angle = solver.state()[0], rate = solver.state()[1];
  return numbers({0.3 * std::sin(2 * t) + std::sin(angle), -std::cos(angle),
                  0.6 * std::cos(2 * t) + std::cos(angle) * rate, std::sin(angle) * rate});
}
/// How far the rod is open at t, and the rate of that.
double rod_open_by(double t, const vector& x) {
  const double along_x = x[0] - 0.3 * std::sin(2 * t), rate = x[2] - 0.6 * std::cos(2 * t);
  return (std::max)(std::abs(std::hypot(along_x, x[1]) - 1), std::abs(along_x * rate + x[1] * x[3]));
}

TEST_CASE("closures on a joint or base that signals move have the accelerations and forces of the closed form") {
  const bool by_joint = GENERATE(true, false);
  const auto c = slotted_bar(by_joint);
  auto s = c.make_state();
  const double p = 0.3, v = 0.7, a = -1.1, tau = 0.4, q = std::acos(p), rate = -v / std::sin(q);
  give(s, by_joint, p, v, a);
  CHECK(consistent_velocities(c, s, numbers({q}), numbers({9}))[0] == within(rate, 1e-15));
  const auto& r = constrained_dynamics(c, s, numbers({q}), numbers({rate}), numbers({tau}));
  const double q_ddot = (-a - p * rate * rate) / std::sin(q);
  CHECK(r.a[0] == within(q_ddot, 1e-14));
  CHECK(r.gap < 1e-15);
  // the row is along -x: its force turns the bar by sin q
  CHECK(r.loop("slot").force.x == within((q_ddot / 3 - tau) / std::sin(q), 1e-14));
  give(s, by_joint, p, 0, a);
  CHECK(consistent_velocities(c, s, numbers({q}), numbers({9}))[0] == within(0, 1e-15));
}

TEST_CASE("a loop that signals turn has the closure forces of the same loop under a torque") {
  const auto driven = driven_parallelogram(), free = four_bars(1);
  auto s = driven.make_state(), t = free.make_state();
  const double angle = 0.7, rate = 1.3;
  const vector q = four_bar_q(1, angle), v = four_bar_v(1, rate);
  const auto& r = constrained_dynamics(free, t, q, v, numbers({2.5, 0, 0}));
  s.input("p") = q[0], s.input("v") = v[0], s.input("a") = r.a[0];
  const vector others = q.tail(2), on = consistent_velocities(driven, s, others, numbers({0, 0}));
  CHECK(largest(on - v.tail(2)) < 1e-15);
  const auto& x = constrained_dynamics(driven, s, others, on, numbers({0, 0}));
  CHECK(x.mobility == 0);
  CHECK(largest(x.a - r.a.tail(2)) < 1e-13);
  CHECK(x.loop("pin0").force.x == within(r.loop("pin0").force.x, 1e-12));
  CHECK(x.loop("pin0").force.y == within(r.loop("pin0").force.y, 1e-12));
}

TEST_CASE("given motions that open a loop are refused, by name") {
  auto c = slotted_bar(true);
  c << rigid_link_2D("base", "post", vec2<>{0.3, 0}) << point_on_line_2D("again", "post", "tip", axis::y);
  auto s = c.make_state();
  const vector q = numbers({std::acos(0.3)}), rest = numbers({0});
  give(s, true, 0.3, 0, 0);
  CHECK(consistent_velocities(c, s, q, numbers({1}))[0] == within(0, 1e-15));
  give(s, true, 0.3, 0.1, 0);
  CHECK_THROWS_MATCHES(consistent_velocities(c, s, q, rest), bad_argument, says("kte: no velocities keep '"));

  const auto bar_in_slot = slotted_bar(true);
  model m(bar_in_slot);
  m.input("p") = 0.3;
  CHECK_NOTHROW(m.make_x(q, rest));
  m.input("v") = 0.125;
  CHECK_THROWS_MATCHES(m.make_x(q, rest), bad_argument,
                       says("kte: inputs give a velocity to a frame of 'slot', which opens at 0.125 m/s"));
  m.let_inputs_move();
  CHECK_THROWS_MATCHES(m.make_x(q, rest), bad_argument, says("kte: the velocities do not keep the loops closed"));
  CHECK_NOTHROW(m.make_x(q, numbers({-0.125 / std::sin(q[0])})));

  runtime_chain measured;
  measured << revolute_joint_2D("q", "base", "arm") << inertia_2D("arm", bar)
           << rigid_link_2D("arm", "tip", along_x(1.0)) << position_measure_gen("q", "y")
           << position_control_gen("y", "v", "a", "x") << prismatic_joint_2D("x", "base", "moved", axis::x)
           << point_on_line_2D("slot", "moved", "tip", axis::y);
  CHECK_THROWS_MATCHES(model(measured), bad_argument, says("'slot' closes a loop with a joint that position_control"));
}

TEST_CASE("a pendulum on a pivot that moves in time, by a closure") {
  const auto c = driven_pendulum();
  const model m(c);
  auto s = c.make_state();
  const vector q = bob_at(1), v = numbers({0.6, 0});
  const vector near = consistent_velocities(c, s, q, numbers({0, 0}));
  CHECK(largest(near - 0.6 * std::sin(1.0) * numbers({std::sin(1.0), -std::cos(1.0)})) < 1e-15);
  CHECK_THROWS_MATCHES(m.make_x(q, numbers({0, 0})), bad_argument,
                       says("kte: the velocities do not keep the loops closed"));
  const vector x0 = m.make_x(q, v), end = bob_of_pendulum(3);
  const auto check = [&](auto&& solver, double tolerance) {
    double open = 0;
    solver.integrate(3.0, every(0.07), [&](double t, const vector& x) { open = (std::max)(open, rod_open_by(t, x)); });
    CHECK(largest(vector(solver.state()) - end) < 1e3 * tolerance);
    CHECK(open < 2e-14);
  };
  const auto form = [&m] { return vector_form(std::cref(m)); };
  for (const double tolerance : {1e-6, 1e-9}) {
    INFO("tolerance " << tolerance);
    const tolerances<double> by{.absolute = tolerance, .relative = tolerance};
    check(prince_dormand87(std::cref(m), 0.0, x0, by), tolerance);
    check(adams(form(), 0.0, x0, by), tolerance);
    check(bdf(form(), 0.0, x0, by), 10 * tolerance);
  }
  check(rodas(std::cref(m), 0.0, x0, {.absolute = 1e-6, .relative = 1e-6}), 1e-6);

  const auto off = [&](double h) {
    runge_kutta4 solver(std::cref(m), 0.0, x0, h);
    solver.integrate(3.0);
    return largest(vector(solver.state()) - end);
  };
  CHECK(std::log2(off(0.02) / off(0.01)) > 3.8);

  prince_dormand87 solver(std::cref(m), 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
  solution all(solver);
  solver.integrate(1.0, all);
  CHECK(rod_open_by(0.37, all(0.37)) < 2e-14);
  // another start time
  m.settle_at(1.0);
  const vector then = bob_of_pendulum(1);
  const vector x1 = m.make_x(vector(then.head(2)), vector(then.tail(2)));
  prince_dormand87 later(std::cref(m), 1.0, x1, {.absolute = 1e-9, .relative = 1e-9});
  later.integrate(3.0);
  CHECK(largest(vector(later.state()) - end) < 1e-6);
}

TEST_CASE("a pendulum on a pivot of constant velocity is one at rest") {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << velocity_control_gen("u", "du", "way", "pivot")
                            << prismatic_joint_2D("pivot", "base", "hook", axis::x)
                            << prismatic_joint_2D("x", "base", "a", axis::x)
                            << prismatic_joint_2D("y", "a", "b", axis::y) << inertia_2D("b", point_mass(1.0))
                            << distance_2D("rod", "hook", "b", 1.0);
  model m(c);
  const auto at_rest = pendulum();
  const model other(at_rest);
  m.input("u") = 0.7;
  const tolerances<double> by{.absolute = 1e-10, .relative = 1e-10};
  prince_dormand87 solver(std::cref(m), 0.0, m.make_x(bob_at(1), numbers({0.7, 0})), by);
  prince_dormand87 resting(std::cref(other), 0.0, other.make_x(bob_at(1), numbers({0, 0})), by);
  solver.integrate(2.0), resting.integrate(2.0);
  CHECK(solver.state()[4] == within(1.4, 1e-12));
  CHECK(solver.state()[0] - 1.4 == within(resting.state()[0], 1e-7));
  CHECK(solver.state()[3] == within(resting.state()[3], 1e-7));
}

}  // namespace given_motion_test
