#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/io/recorder.hpp>
#include <kte/io/table.hpp>

#include "catch.hpp"
#include "closed_loops/linkages.hpp"
#include "io/scratch.hpp"

namespace hard_cases_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using model = manipulator_dynamics_model<runtime_chain>;

struct end_of_run {
  vector q, v;
  double open = 0;
  long long evaluations = 0;
};
template <template <class, class> class Solver, class How>
end_of_run run(const runtime_chain& c, const vector& q, const vector& v, double t, const How& how) {
  model m(c);
  Solver<std::reference_wrapper<const model>, vector> solver(std::cref(m), 0.0, m.make_x(q, v), how);
  solver.integrate(t);
  const auto& x = solver.state();
  auto s = c.make_state();
  const vector at = m.positions_of(x);
  return {at, m.velocities_of(x), kte::loops(c, s, at).gap, solver.statistics().evaluations};
}
const tolerances<double> fine{.absolute = 1e-12, .relative = 1e-12};

TEST_CASE("Andrews' squeezer with three pins") {
  const auto c = andrews();
  auto s = c.make_state();
  const vector q = assemble(c, s, andrews_start(), held("q1")), none = vector::Zero(7);
  // accelerations at the start, to 30 digits by an independent calculation
  const auto r = constrained_dynamics(c, s, q, none, none);
  CHECK(r.a[0] == within(14222.4439199541138705911, 1e-8));
  CHECK((r.rank == 6 && r.mobility == 1));
  for (const double tolerance : {1e-6, 1e-9, 1e-11}) {
    const auto end =
        run<prince_dormand87>(c, q, none, 0.03, tolerances<double>{.absolute = tolerance, .relative = tolerance});
    CHECK(end.q[0] == within(15.8107711951537070971, 100 * tolerance));
    CHECK(end.v[0] == within(1139.92030225910606419, 1e5 * tolerance));
    CHECK(end.open < 1e-14);
  }
}

TEST_CASE("a governor with its hinges cut moves as the tree does") {
  const auto c = cut_governor();
  const vector q = cut_governor_q();
  auto s = c.make_state();
  CHECK(kte::loops(c, s, q).mobility == 4);
  const vector v = consistent_velocities(c, s, q, cut_governor_v());
  CHECK(v[0] == within(2 * pi, 1e-13));
  const auto end = run<runge_kutta4>(c, q, v, 0.1, 1e-4);
  CHECK(end.q[1] == within(0.523836475569576, 1e-11));
  CHECK(end.open < 1e-14);
}

TEST_CASE("Sarrus' linkage moves along a line, though its closure has a redundant row") {
  const auto c = sarrus();
  auto s = c.make_state();
  const auto of = [](double x) { return numbers({x, -2 * x, x, x, -2 * x}); };
  const auto report = kte::loops(c, s, of(0.7));
  CHECK((report.rows == 5 && report.rank == 4 && report.mobility == 1 && report.gap < 1e-15));
  const auto end = run<prince_dormand87>(c, of(0.7), of(-0.5), 1.0, fine);
  CHECK(end.q[0] == within(sarrus_angle(0.7, -0.5, 1.0), 1e-10));
  CHECK((end.q - of(end.q[0])).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("a third parallel bar is redundant") {
  const auto c = three_parallel_bars();
  auto s = c.make_state();
  const auto of = [](double x) { return numbers({x, x, x, -x}); };
  const auto report = kte::loops(c, s, of(0.4));
  CHECK((report.rows == 4 && report.rank == 3 && report.dependent.size() == 1));
  const auto f = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -1.25 * 9.81 * std::cos(x[0])); };
  prince_dormand87 exact(f, 0.0, Eigen::Vector2d(0.4, 7.0), {.absolute = 1e-14, .relative = 1e-14});
  exact.integrate(3.0);
  const auto end = run<prince_dormand87>(c, of(0.4), of(7.0), 3.0, fine);
  CHECK(end.q[0] == within(exact.state()[0], 1e-9));
  CHECK((end.q - of(end.q[0])).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("masses in a loop may differ a million times") {
  for (const double mass : {1e-6, 1e6}) {
    INFO(mass);
    const auto c = parallelogram(mass);
    auto s = c.make_state();
    const double phi = 0.6, k = 9.81 * (1 + mass) / (2.0 / 3 + mass);
    const auto r = constrained_dynamics(c, s, four_bar_q(1, phi), four_bar_v(1, 2), vector::Zero(3));
    CHECK(-r.a[0] == within_relative(k * std::sin(phi), mass > 1 ? 1e-9 : 1e-13));
    const auto f = [k](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], k * std::sin(x[0])); };
    prince_dormand87 exact(f, 0.0, Eigen::Vector2d(phi, 1.0), {.absolute = 1e-14, .relative = 1e-14});
    exact.integrate(1.0);
    const auto end = run<prince_dormand87>(c, four_bar_q(1, phi), four_bar_v(1, 1), 1.0, fine);
    CHECK(pi / 2 - end.q[0] == within(exact.state()[0], 1e-8));
    CHECK(end.open < 1e-14);
  }
}

TEST_CASE("assembly turns no further than it must") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "a") << inertia_2D("a", bar) << rigid_link_2D("a", "tip", along_x(1.0))
    << rigid_link_2D("base", "shelf", vec2<>{0, 0.5}) << point_on_line_2D("l", "shelf", "tip", axis::x);
  auto s = c.make_state();
  // sin q = 1/2 from where its derivative all but vanishes: a step of Newton's method would be many turns
  for (const double off : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    INFO(off);
    CHECK(assemble(c, s, numbers({pi / 2 - off}))[0] == within(pi / 6, 1e-14));
    CHECK(assemble(c, s, numbers({pi / 2 + off}))[0] == within(5 * pi / 6, 1e-14));
    CHECK(assemble(c, s, numbers({pi / 2 + 4 * pi - off}))[0] == within(pi / 6 + 4 * pi, 1e-13));
  }
}

TEST_CASE("recorders have the forces and residuals of closures") {
  const auto c = four_bars(1);
  const scratch file(".csv");
  model m(c);
  auto s = c.make_state();
  const vector q = four_bar_q(1, 0.4), v = four_bar_v(1, 1);
  const auto r = constrained_dynamics(c, s, q, v, vector::Zero(3));
  {
    recorder out(file.path, c, {"pin0/force", "pin0/residual"});
    out.row(0, m.state_at(0, m.make_x(q, v)));
    out.close();
  }
  const auto text = file.text();
  const auto line = text.substr(text.find('\n') + 1);
  CHECK(text.starts_with("t,pin0/force"));
  double t = 1, x = 0, y = 0;
  REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &x, &y) == 3);
  CHECK((t == 0 && x == within(r.loop("pin0").force.x, 1e-12) && y == within(r.loop("pin0").force.y, 1e-12)));
  CHECK(text.find("pin0/residual") < text.find('\n'));
}

}  // namespace hard_cases_test
