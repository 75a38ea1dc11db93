#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/math/dual.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"

namespace integrator_test {

using namespace kte;
using kte::test::contains_text, kte::test::worse;

using scalar_state = Eigen::Matrix<double, 1, 1>;
constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("integrators land exactly on the end, with no tiny last step") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0));
  for (int i = 1; i <= 500; ++i) {
    std::vector<double> times;
    const double end = 3 + i * 0.0137;
    solver.restart(i / 900.0, Eigen::Vector2d(1, 0));
    solver.integrate(end, [&](double t, const Eigen::Vector2d&) { times.push_back(t); });
    CHECK(solver.time() == end);
    const std::size_t n = times.size();
    CHECK(times[n - 1] - times[n - 2] > 0.4 * (times[n - 2] - times[n - 3]));
  }
  solver.integrate(std::nextafter(solver.time(), 100.0));
  CHECK(solver.time() == std::nextafter(3 + 500 * 0.0137, 100.0));
}

TEST_CASE("integrators go back to where they came from") {
  dormand_prince45 solver(oscillator, 5.0, Eigen::Vector2d(1, 0), {.absolute = 1e-11, .relative = 1e-11});
  solver.integrate(-5);
  CHECK(solver.time() == -5);
  CHECK(solver.state()[0] == within(std::cos(10.0), 1e-9));
  CHECK(solver.state()[1] == within(std::sin(10.0), 1e-9));
  std::vector<double> times;
  solver.integrate(5);
  CHECK(solver.state()[0] == within(1.0, 1e-9));
  solver.integrate(4.5, every(0.2), [&](double t, const auto& x) {
    times.push_back(t);
    CHECK(x[0] == within(std::cos(t - 5), 1e-8));
  });
  CHECK(times == std::vector<double>{5, 5 - 0.2, 5 - 2 * 0.2, 4.5});
}

TEST_CASE("samples are counted, not summed, and end exactly") {
  std::vector<double> times;
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0), {.absolute = 1e-9, .relative = 1e-9});
  solver.integrate(20, every(0.001), [&](double t, const auto& x) {
    times.push_back(t);
    REQUIRE(x[0] == within(std::cos(t), 2e-7));
    REQUIRE(x[1] == within(-std::sin(t), 2e-7));
  });
  REQUIRE(times.size() == 20001);
  for (std::size_t i = 0; i < 20000; ++i) REQUIRE(times[i] == static_cast<double>(i) * 0.001);
  CHECK(times.back() == 20.0);
  CHECK(solver.statistics().steps < 1000);
}

TEST_CASE("a grid of times ends where it is told, without a rest of rounding errors") {
  const auto intervals = [](double start, double end, double spacing) {
    const time_grid<double> grid(start, end, spacing, "step");
    CHECK(grid[0] == start);
    CHECK(grid[grid.intervals()] == end);
    return grid.intervals();
  };
  CHECK(intervals(0, 1, 0.3) == 4);
  CHECK(intervals(0, 3 * 0.1, 0.1) == 3);  // 3 * 0.1 is above 0.3
  CHECK(intervals(3 * 0.1, 0, 0.1) == 3);
  CHECK(intervals(300, std::nextafter(300, 301.0), 0.1) == 1);  // as short as it may be
  CHECK(intervals(5, 5, 0.1) == 0);
  // spacings of a few roundings of the times
  CHECK_THROWS_WITH(intervals(1e6, 1e6 + 1e-9, 5e-10), contains_text("is too small to go from 1000000 to 1000000"));
  CHECK_THROWS_AS(intervals(-1e6, -1e6 - 1e-9, 5e-10), bad_argument);
  CHECK(intervals(1e6, 1e6 + 1e-8, 5e-9) == 2);
}

TEST_CASE("a solution goes backward as well, but does not turn back") {
  const Eigen::Vector2d start(1, 0), other(0, 1);
  constexpr double first = 1 / 64.0;
  dormand_prince45 solver(oscillator, 0.0, start, {.absolute = 1e-9, .relative = 1e-9, .initial_step = first});
  solution x(solver);
  CHECK(x(0) == start);
  auto sampled = solver;
  solver.integrate(-5, x);
  CHECK(x.steps() == static_cast<std::size_t>(solver.statistics().steps));
  CHECK(x(0) == start);
  CHECK(x(-5) == solver.state());
  double gap = 0;
  sampled.integrate(-5, every(0.01), [&](double t, const auto& at_t) { gap = worse(gap, (x(t) - at_t).norm()); });
  CHECK(gap < 1e-14);                                                     // rounding of numbers up to 1
  const double kept = (1 - std::cos(std::numbers::pi / 2)) / 2 * -first;  // a time that it keeps
  CHECK((x(kept) - Eigen::Vector2d(std::cos(kept), -std::sin(kept))).norm() < 1e-9);
  CHECK_THROWS_WITH(x(0.5), contains_text("goes from t = 0 to -5, not to 0.5"));
  CHECK_THROWS_WITH(solver.integrate(0, x), contains_text("a solution must not reverse its direction"));
  solver.restart(-5, other);
  solver.integrate(-5, x);
  CHECK(x(-5) == other);
  solver.integrate(-6, x);
  CHECK(x(-5) == other);
}

TEST_CASE("samples do not change the steps") {
  dormand_prince45 plain(oscillator, 0.0, Eigen::Vector2d(1, 0)), sampled = plain;
  plain.integrate(10);
  sampled.integrate(10, every(0.01), [](double, const auto&) {});
  CHECK(plain.state() == sampled.state());
  CHECK(plain.statistics().evaluations == sampled.statistics().evaluations);
}

TEST_CASE("samples at the times of a list, in either direction") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0), {.absolute = 1e-9, .relative = 1e-9}), plain = solver;
  std::vector<double> seen;
  const auto check = [&](double t, const auto& x) {
    seen.push_back(t);
    CHECK(x[0] == test::within(std::cos(t), 1e-7));
  };
  const std::vector times{0.0, 0.1, 0.11, 2.5, 2.5, 3.0};
  CHECK(solver.integrate(3, at(times), check) == stop_reason::end_time);
  CHECK(seen == times);
  plain.integrate(3);
  CHECK(plain.state() == solver.state());
  seen.clear();
  solver.integrate(1, at{2.5, 1.5}, check);
  CHECK(seen == std::vector{2.5, 1.5});
  CHECK_THROWS_WITH(solver.integrate(2, at{1.5, 1.25}, check),
                    "kte: output time 1 is 1.25, not between 1.5 and 2: they go in order from the present time to the "
                    "end time");
  CHECK_THROWS_AS(solver.integrate(2, at{nan}, check), bad_argument);
  CHECK(solver.time() == 1);
}

TEST_CASE("steps end where they are told, also where the right-hand side jumps there") {
  double push = 1;  // to 0.7, then -1: each part is exact
  const auto thrust = [&](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], push); };
  dormand_prince45 solver(thrust, 0.0, Eigen::Vector2d(0, 0));
  std::vector<double> ends, samples;
  solver.integrate(2, through{0.7, 1.2}, [&](double t, const auto&) {
    ends.push_back(t);
    if (t == 0.7) push = -1;
  });
  for (double t : {0.0, 0.7, 1.2, 2.0}) CHECK(std::count(ends.begin(), ends.end(), t) == 1);
  CHECK(solver.state()[0] == test::within(0.245 + 0.7 * 1.3 - 0.845, 1e-14));
  solver.restart(0, Eigen::Vector2d(0, 0));
  solver.integrate(2, through{0.7}, every(0.5), [&](double t, const auto&) { samples.push_back(t); });
  CHECK(samples == std::vector{0.0, 0.5, 1.0, 1.5, 2.0});
  CHECK_THROWS_WITH(solver.integrate(3, through{1.5}), contains_text("stop time 0 is 1.5, not between 2 and 3"));
}

TEST_CASE("an observer may stop the integration, where it says so") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0));
  const auto down_to = [](double least) {
    return [least](double, const auto& x) { return x[0] > least ? go_on : stop; };
  };
  CHECK(solver.integrate(10, down_to(0.5)) == stop_reason::observer);
  CHECK(solver.state()[0] <= 0.5);
  CHECK(solver.time() < 10);
  solver.restart(0, Eigen::Vector2d(1, 0));
  CHECK(solver.integrate(10, every(0.01), down_to(0.25)) == stop_reason::observer);
  CHECK(solver.time() == 132 * 0.01);  // acos(0.25) = 1.3181
  CHECK(solver.state()[0] == test::within(std::cos(1.32), 1e-5));
  CHECK(kte::integrate(solver, 1.5, every(0.01), down_to(-1)) == stop_reason::end_time);
}

TEST_CASE("the dense output is continuous, with its slope, at the ends of steps") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0));
  CHECK(solver.interpolate(0) == Eigen::Vector2d(1, 0));
  double before = 0;
  Eigen::Vector2d x_before(1, 0);
  solver.integrate(10, [&](double t, const Eigen::Vector2d& x) {
    if (t == before) return;
    CHECK(solver.interpolate(before) == x_before);
    CHECK(solver.interpolate(t) == x);
    const double d = (t - before) * 1e-6;
    CHECK((solver.interpolate(before + d) - x_before - d * oscillator(before, x_before)).norm() < 1e-11);
    CHECK((solver.interpolate(t - d) - x + d * oscillator(t, x)).norm() < 1e-11);
    before = t, x_before = x;
  });
  CHECK_THROWS_WITH(solver.interpolate(10.5), contains_text("cannot interpolate at t = 10.5"));
  CHECK_THROWS_AS(solver.interpolate(0.1), bad_argument);
  CHECK_THROWS_AS(solver.interpolate(nan), bad_argument);
}

TEST_CASE("the right-hand side may change between calls, and the state by restart") {
  double input = 1;
  dormand_prince45 solver([&](double, const scalar_state&) { return scalar_state(input); }, 0.0, scalar_state(0.0));
  solver.integrate(1);
  input = -1;
  solver.integrate(2);
  CHECK(solver.state()[0] == within(0.0, 1e-14));
  solver.restart(7, 2 * scalar_state(4.0));
  CHECK(solver.time() == 7);
  CHECK(solver.interpolate(7)[0] == 8);
  solver.integrate(8);
  CHECK(solver.state()[0] == within(7.0, 1e-14));  // exact, but for roundings of 4e-16 in less than 20 steps
}

TEST_CASE("large times, and nothing to do") {
  dormand_prince45 late(oscillator, 1e12, Eigen::Vector2d(1, 0));
  late.integrate(1e12 + 1);
  CHECK(late.state()[0] == within(std::cos(1.0), 1e-3));
  dormand_prince45 still(oscillator, 3.0, Eigen::Vector2d(1, 0));
  int calls = 0;
  still.integrate(3, every(0.1), [&](double, const auto&) { ++calls; });
  CHECK(calls == 1);
  CHECK(still.statistics().evaluations == 0);
  dormand_prince45 rest([](double, const scalar_state&) { return scalar_state(0.0); }, 0.0, scalar_state(0.0));
  rest.integrate(1e6);
  CHECK(rest.state()[0] == 0);
  CHECK(rest.statistics().steps < 30);
}

TEST_CASE("dynamic states, and sizes that do not fit") {
  const auto f = [](double, const Eigen::VectorXd& x) -> Eigen::VectorXd { return -x; };
  dormand_prince45 solver(f, 0.0, Eigen::VectorXd::Ones(5), {.absolute = 1e-9, .relative = 1e-9});
  solver.integrate(1);
  CHECK((solver.state().array() - std::exp(-1.0)).abs().maxCoeff() < 1e-8);
  const auto g = [](double, const Eigen::VectorXd&) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(3); };
  euler wrong(g, 0.0, Eigen::VectorXd::Ones(5), 0.1);
  CHECK_THROWS_WITH(wrong.integrate(1), contains_text("gave 3 numbers for a state of 5"));
  CHECK_THROWS_AS(wrong.integrate(1), bad_argument);  // a mistake: no shorter step is tried
  CHECK_THROWS_WITH(euler(f, 0.0, Eigen::VectorXd(), 0.1), contains_text("empty"));
}

TEST_CASE("states of dual numbers carry derivatives through steps, and messages have their values") {
  using number = dual<double, 1>;
  using state = Eigen::Matrix<number, 1, 1>;
  const number rate = seeded<1>(-2.0, 0);  // x = exp(rate t), dx/drate = t exp(rate t)
  runge_kutta4 solver([&](const number&, const state& x) { return state(rate * x[0]); }, number(0), state(number(1)),
                      number(1e-3));
  solver.integrate(0.5);
  CHECK(solver.statistics().steps == 500);
  CHECK(solver.state()[0].value == within(std::exp(-1), 1e-12));
  CHECK(solver.state()[0].derivative[0] == within(0.5 * std::exp(-1), 1e-12));
  CHECK_THROWS_WITH(solver.integrate(std::nan("")), contains_text("end time must be finite, got nan"));
  CHECK_THROWS_WITH(solver.interpolate(7.0), contains_text("cannot interpolate at t = 7"));
}

}  // namespace integrator_test
