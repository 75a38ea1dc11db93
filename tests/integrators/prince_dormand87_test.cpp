#include <kte/integrators/prince_dormand87.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "integrators/two_oscillators.hpp"

namespace prince_dormand87_test {

using namespace kte;
using namespace kte::test;

TEST_CASE("Prince-Dormand: the global error is of order 8") {
  const auto error = [](int n) {  // of the energy, which has no zeros
    auto solver = one_step_solver<prince_dormand87>(pendulum, horizontal<real50>());
    const auto before = solver.statistics().steps;
    for (int i = 1; i <= n; ++i) solver.integrate(real50(i) / (2 * n));
    REQUIRE(solver.statistics().steps == before + n);
    const state<real50>& x = solver.state();
    return real50(abs(x[1] * x[1] / 2 - real50(981) / 50 * cos(x[0])));
  };
  // Errors of 1.6e-13 and 5e-16: with shorter steps those of the published fractions show, with longer ones order 9.
  CHECK(slope(error(24), error(48)) == within(8.0, 0.3));
}

TEST_CASE("Prince-Dormand: the dense output is of order 7: its error in one step falls with h^8") {
  const auto worst = [](const real50& h) { return error_within_step<prince_dormand87>(h); };
  CHECK(slope(worst(real50(1) / 4), worst(real50(1) / 8)) == within(8.0, 0.1));
  CHECK(slope(worst(real50(1) / 8), worst(real50(1) / 16)) == within(8.0, 0.1));
}

TEST_CASE("Prince-Dormand: between the ends of steps the error is that at the ends") {
  prince_dormand87 solver(oscillator, 0.0, state<double>(1, 0), {.absolute = 1e-10, .relative = 1e-10});
  double at_ends = 0, between = 0;
  const auto error = [](double t, const state<double>& x) { return (x - state<double>(cos(t), -sin(t))).norm(); };
  auto sampled = solver;
  solver.integrate(20, [&](double t, const auto& x) { at_ends = test::worse(at_ends, error(t, x)); });
  sampled.integrate(20, every(0.01), [&](double t, const auto& x) { between = test::worse(between, error(t, x)); });
  CHECK(between < 4 * at_ends);  // the cubic through both ends: 1e5 times
  CHECK(sampled.state() == solver.state());
}

TEST_CASE("Prince-Dormand: a step costs thirteen evaluations, one asked for times within it four more, once") {
  long long calls = 0;
  const auto f = [&](double t, const state<double>& x) {
    ++calls;
    return pendulum(t, x);
  };
  prince_dormand87 solver(f, 0.0, horizontal<double>());
  solver.integrate(10);
  const auto plain = solver.statistics();
  CHECK(plain.rejected > 0);
  CHECK(plain.evaluations == 2 + 13 * (plain.steps + plain.rejected));  // the start, the first step size
  const double t = solver.time() - 0.01;
  CHECK(solver.interpolate(10) == solver.state());
  CHECK(solver.statistics().evaluations == plain.evaluations);
  const state<double> x = solver.interpolate(t);
  CHECK(solver.statistics().evaluations == plain.evaluations + 4);
  CHECK(solver.interpolate(t) == x);
  CHECK(solver.interpolate(t - 0.01) != x);
  CHECK(solver.statistics().evaluations == plain.evaluations + 4);
  solver.integrate(12, every(0.001), [](double, const auto&) {});  // in every step
  const auto all = solver.statistics();
  CHECK(all.evaluations == 3 + 4 + 13 * (all.steps + all.rejected) + 4 * (all.steps - plain.steps));
  CHECK(all.evaluations == calls);
}

TEST_CASE("Prince-Dormand: the pendulum in every scalar") {
  prince_dormand87 f(pendulum, 0.0f, horizontal<float>(), {.absolute = 1e-5f, .relative = 1e-5f});
  prince_dormand87 d(pendulum, 0.0, horizontal<double>(), {.absolute = 1e-13, .relative = 1e-13});
  prince_dormand87 l(pendulum, 0.0l, horizontal<long double>(), {.absolute = 1e-16l, .relative = 1e-16l});
  prince_dormand87 m(pendulum, real50(0), horizontal<real50>(), {.absolute = 1e-17, .relative = 1e-17});
  f.integrate(1), d.integrate(1), l.integrate(1), m.integrate(1);
  CHECK(static_cast<double>(f.state()[0]) == within(static_cast<double>(theta1), 2e-4));
  CHECK(d.state()[0] == within(static_cast<double>(theta1), 1e-12));
  CHECK(abs(real50(l.state()[0]) - theta1) < 1e-15);
  CHECK(abs(m.state()[0] - theta1) < 1e-15);  // the fractions: 7e-18 times slopes of 5 to 20 and their growth
}

TEST_CASE("Prince-Dormand: the error follows the tolerance, at a lower price than with order 5") {
  const auto solve = [](double tolerance) {
    prince_dormand87 solver(pendulum, 0.0, horizontal<double>(), {.absolute = tolerance, .relative = tolerance});
    solver.integrate(10);
    CHECK(std::abs(solver.state()[0] - theta10) < 10 * tolerance);  // near a turning point
    solver.integrate(50);
    CHECK(std::abs(solver.state()[0] - theta50) < 4000 * tolerance);  // the phase goes with the square of the time
    return solver.statistics().evaluations;
  };
  const auto evaluations = solve(1e-6);
  CHECK(evaluations < 4500);
  CHECK(static_cast<double>(solve(1e-9)) ==
        within_relative(static_cast<double>(evaluations) * std::pow(1e3, 0.125), 0.2));
  CHECK(static_cast<double>(solve(1e-12)) ==
        within_relative(static_cast<double>(evaluations) * std::pow(1e6, 0.125), 0.2));
}

TEST_CASE("Prince-Dormand: a right-hand side that is NaN between the ends of a step says so") {
  bool broken = false;
  const auto f = [&](double, const state<double>& x) {
    return state<double>(x[1], broken ? std::numeric_limits<double>::quiet_NaN() : -x[0]);
  };
  prince_dormand87 solver(f, 0.0, state<double>(1, 0));
  solver.integrate(1);
  broken = true;
  CHECK_THROWS_WITH(solver.interpolate(0.99), contains_text("not a finite number between the ends of the last step"));
  CHECK(solver.interpolate(1) == solver.state());
  broken = false;
  CHECK(solver.interpolate(0.99)[0] == within_relative(std::cos(0.99), 1e-5));
}

/// Rotations by the unit quaternion (x, y, z, w), turning at w(t) = (sin t, cos 2t, 1) in their own axes. Displacements
/// are rotation vectors, whose rate is dexp^-1, here as a series.
struct turning {
  using rate = Eigen::Vector3d;
  Eigen::Index rates() const { return 3; }
  rate operator()(double t, const Eigen::Vector4d&) const { return {std::sin(t), std::cos(2 * t), 1}; }
  void displace(const Eigen::Vector4d& x, const rate& d, Eigen::Vector4d& out) const {
    const double angle = d.norm(), by = angle < 1e-8 ? 0.5 : std::sin(angle / 2) / angle;
    const Eigen::Vector3d v = by * d, u = x.head<3>();
    const double c = std::cos(angle / 2);
    out << x[3] * v + c * u + u.cross(v), x[3] * c - u.dot(v);
  }
  void pull_back(const rate& d, rate& r) const {  // r + d x r / 2 + (1 - a/2 cot a/2) / a^2 d x (d x r)
    const double a = d.norm();
    const double by = a < 1e-3 ? 1 / 12.0 + a * a / 720 : (1 - a / 2 / std::tan(a / 2)) / (a * a);
    const Eigen::Vector3d dr = d.cross(r);
    r += (dr / 2 + by * d.cross(dr)).eval();
  }
  void magnitudes(const Eigen::Vector4d&, rate& m) const { m.setOnes(); }
};

TEST_CASE("Prince-Dormand: states on groups, at the ends of steps and between them") {
  const Eigen::Vector4d x0(0, 0, 0, 1);
  prince_dormand87 exact(turning{}, 0.0, x0, {.absolute = 1e-14, .relative = 1e-14});
  prince_dormand87 solver(turning{}, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
  double most = 0;
  solver.integrate(10, every(0.05), [&](double t, const Eigen::Vector4d& x) {
    if (t > 0) exact.integrate(t);
    most = test::worse(most, (x - exact.state()).norm());
    CHECK(x.norm() == within_relative(1.0, 1e-12));
  });
  CHECK(most < 1e-8);
  CHECK(solver.statistics().steps < 60);  // so that most samples are between the ends
}

}  // namespace prince_dormand87_test
