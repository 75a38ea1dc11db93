#include <kte/integrators/dormand_prince45.hpp>

#include <limits>

#include "catch.hpp"

using namespace kte;
using kte::test::contains_text;

namespace {

using scalar_state = Eigen::Matrix<double, 1, 1>;
constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
constexpr auto square = [](double, const scalar_state& x) { return scalar_state(x[0] * x[0]); };
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

TEST_CASE("A blow-up in finite time stops with the last good state") {
  dormand_prince45 solver(square, 0.0, scalar_state(1.0));
  CHECK_THROWS_WITH(solver.integrate(2), contains_text("stopped at t = ") && contains_text("lost in the rounding"));
  CHECK(solver.time() == within_relative(1.0, 1e-4));
  CHECK(solver.state()[0] > 1e6);
  CHECK(std::isfinite(solver.state()[0]));
  CHECK(solver.interpolate(solver.time()) == solver.state());
  CHECK_THROWS_AS(solver.integrate(2), integration_failure);
}

TEST_CASE("A right-hand side that is not a number stops the integration before it") {
  const auto f = [](double t, const scalar_state&) { return scalar_state(t < 0.5 ? 1.0 : nan); };
  dormand_prince45 solver(f, 0.0, scalar_state(0.0));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0.49999") && contains_text("not a finite number"));
  CHECK(solver.state()[0] == within(solver.time(), 1e-14));  // exact, but for 100 roundings of 0.5
  CHECK(solver.statistics().rejected < 100);
  dormand_prince45 at_once(f, 0.7, scalar_state(3.0));
  CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));
  CHECK(at_once.state()[0] == 3.0);
  const auto later = [](double t, const scalar_state&) { return scalar_state(t == 0.0 ? 1.0 : inf); };
  dormand_prince45 from_zero(later, 0.0, scalar_state(3.0));
  CHECK_THROWS_WITH(from_zero.integrate(1), contains_text("t = 0:") && contains_text("not a finite number"));
}

TEST_CASE("Too many steps") {
  const auto stiff = [](double t, const scalar_state& x) { return scalar_state(-1e6 * (x[0] - std::cos(t))); };
  dormand_prince45 solver(stiff, 0.0, scalar_state(0.0), {.max_steps = 1000});
  CHECK_THROWS_WITH(solver.integrate(10), contains_text("max_steps = 1000"));
  CHECK(solver.statistics().steps + solver.statistics().rejected == 1000);
  CHECK(solver.time() > 0);
  CHECK(solver.state()[0] == within(std::cos(solver.time()), 1e-2));
}

TEST_CASE("Bad settings are rejected with their value") {
  const Eigen::Vector2d x(1, 0);
  for (double bad : {0.0, -1e-6, nan, inf}) {
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.absolute = bad}), bad_argument);
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.relative = bad}), bad_argument);
    dormand_prince45 solver(oscillator, 0.0, x);
    CHECK_THROWS_AS(solver.integrate(1, every(bad), [](double, const auto&) {}), bad_argument);
  }
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.relative = -0.25}),
                    contains_text("relative tolerance must be finite and positive, got -0.25"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.max_steps = 0}), contains_text("max_steps"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, nan, x), contains_text("start time must be finite, got nan"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, Eigen::Vector2d(0, inf)), contains_text("start state"));
  dormand_prince45 solver(oscillator, 0.0, x);
  CHECK_THROWS_WITH(solver.integrate(nan), contains_text("end time must be finite, got nan"));
  CHECK(solver.time() == 0);
}

}  // namespace
