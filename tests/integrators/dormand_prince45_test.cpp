#include <kte/integrators/dormand_prince45.hpp>

#include "catch.hpp"
#include "integrators/two_oscillators.hpp"

namespace dormand_prince45_test {

using namespace kte;
using namespace kte::test;

template <class F>
real50 error_at_1(const F& f, const state<real50>& x0, const real50& exact, int n) {
  auto solver = one_step_solver<dormand_prince45>(f, x0);
  const auto before = solver.statistics().steps;
  for (int i = 1; i <= n; ++i) solver.integrate(real50(i) / n);
  REQUIRE(solver.statistics().steps == before + n);
  return abs(solver.state()[0] - exact);
}

TEST_CASE("Dormand-Prince: the global error is of order 5") {
  const state<real50> x0 = horizontal<real50>(), y0(1, 0);
  for (int n : {128, 256}) {
    CHECK(slope(error_at_1(pendulum, x0, theta1, n), error_at_1(pendulum, x0, theta1, 2 * n)) == within(5.0, 0.1));
    const real50 c = cos(real50(1));
    CHECK(slope(error_at_1(oscillator, y0, c, n), error_at_1(oscillator, y0, c, 2 * n)) == within(5.0, 0.1));
  }
}

TEST_CASE("Dormand-Prince: the dense output is of order 4: its error in one step falls with h^5") {
  const auto worst = [](const real50& h) { return error_within_step<dormand_prince45>(h); };
  CHECK(slope(worst(real50(1) / 64), worst(real50(1) / 128)) == within(5.0, 0.1));
  CHECK(slope(worst(real50(1) / 128), worst(real50(1) / 256)) == within(5.0, 0.1));
}

TEST_CASE("Dormand-Prince: the pendulum in every scalar") {
  dormand_prince45 f(pendulum, 0.0f, horizontal<float>(), {.absolute = 1e-5f, .relative = 1e-5f});
  dormand_prince45 d(pendulum, 0.0, horizontal<double>(), {.absolute = 1e-12, .relative = 1e-12});
  dormand_prince45 l(pendulum, 0.0l, horizontal<long double>(), {.absolute = 1e-15l, .relative = 1e-15l});
  dormand_prince45 m(pendulum, real50(0), horizontal<real50>(), {.absolute = 1e-16, .relative = 1e-16});
  f.integrate(1), d.integrate(1), l.integrate(1), m.integrate(1);
  const double exact = static_cast<double>(theta1);
  CHECK(static_cast<double>(f.state()[0]) == within(exact, 2e-4));
  CHECK(d.state()[0] == within(exact, 1e-11));
  CHECK(abs(real50(l.state()[0]) - theta1) < 1e-14);
  CHECK(abs(m.state()[0] - theta1) < 1e-15);
}

TEST_CASE("Dormand-Prince: the error follows the tolerance, at a modest price") {
  const auto solve = [](double tolerance) {
    dormand_prince45 solver(pendulum, 0.0, horizontal<double>(), {.absolute = tolerance, .relative = tolerance});
    solver.integrate(10);
    const double error10 = std::abs(solver.state()[0] - theta10);
    const double steps10 = static_cast<double>(solver.statistics().steps);
    solver.integrate(50);
    const double error50 = std::abs(solver.state()[0] - theta50);
    UNSCOPED_INFO(tolerance << ": errors " << error10 << ' ' << error50 << ", evaluations "
                            << solver.statistics().evaluations << ", steps " << solver.statistics().steps << " + "
                            << solver.statistics().rejected);
    // A step may miss by sqrt(2) times the tolerance and the weights 1 + pi / 2 and 1 + 6.3: by less than 10 in the
    // angle, and by 136 in the energy. The period of 1.67 s changes by 0.0195 s for each unit of energy, so the phase
    // by 1.6 s in each later second, the angle by up to 10; on the average over the steps, in half of the time.
    const auto bound = [&](double t, double steps) { return steps * tolerance * (10 + 10 * t / 2); };
    CHECK(error10 < bound(10, steps10));
    CHECK(error50 < bound(50, static_cast<double>(solver.statistics().steps)));
    return static_cast<double>(solver.statistics().evaluations);
  };
  const double evaluations = solve(1e-6);
  CHECK(evaluations < 5000);
  CHECK(solve(1e-9) == within_relative(evaluations * std::pow(1e3, 0.2), 0.2));
  CHECK(solve(1e-12) == within_relative(evaluations * std::pow(1e6, 0.2), 0.2));
}

TEST_CASE("Dormand-Prince: a step costs six evaluations") {
  long long calls = 0;
  dormand_prince45 solver(
      [&](double t, const state<double>& x) {
        ++calls;
        return pendulum(t, x);
      },
      0.0, horizontal<double>());
  CHECK(calls == 0);
  solver.integrate(3);
  const auto first = solver.statistics();
  CHECK(first.rejected > 0);
  CHECK(first.evaluations == 2 + 6 * (first.steps + first.rejected));  // the start, the first step size
  solver.integrate(5);
  const auto second = solver.statistics();
  CHECK(second.evaluations == 3 + 6 * (second.steps + second.rejected));  // the start of the second call
  CHECK(second.evaluations == calls);
}

TEST_CASE("Dormand-Prince: tolerances hold for each component by its own size") {
  const auto decay = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(-x[0], -2 * x[1]); };
  dormand_prince45 solver(decay, 0.0, Eigen::Vector2d(1e9, 1e-9), {.absolute = 1e-30, .relative = 1e-9});
  solver.integrate(3);
  CHECK(solver.state()[0] == within_relative(1e9 * std::exp(-3), 2e-8));
  CHECK(solver.state()[1] == within_relative(1e-9 * std::exp(-6), 2e-8));
  dormand_prince45 loose(decay, 0.0, Eigen::Vector2d(1e9, 1e-9), {.absolute = 1e3, .relative = 1e-12});
  loose.integrate(3);
  CHECK(4 * loose.statistics().steps < solver.statistics().steps);
}

}  // namespace dormand_prince45_test
