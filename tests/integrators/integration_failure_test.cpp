#include <kte/integrators/dormand_prince45.hpp>

#include <limits>

#include "catch.hpp"

namespace integration_failure_test {

using namespace kte;
using kte::test::contains_text;
using kte::test::within;

using scalar_state = Eigen::Matrix<double, 1, 1>;
constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
constexpr auto square = [](double, const scalar_state& x) { return scalar_state(x[0] * x[0]); };
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

TEST_CASE("a blow-up in finite time stops with the last good state") {
  dormand_prince45 solver(square, 0.0, scalar_state(1.0));
  CHECK_THROWS_WITH(solver.integrate(2), contains_text("stopped at t = ") && contains_text("lost in the rounding"));
  CHECK(solver.time() == within(1.0, 1e-4));  // x = 1e6 at 1e-6 before it
  CHECK(solver.state()[0] > 1e6);
  CHECK(std::isfinite(solver.state()[0]));
  CHECK(solver.interpolate(solver.time()) == solver.state());
  CHECK_THROWS_AS(solver.integrate(2), integration_failure);
}

TEST_CASE("a right-hand side that is not a number stops the integration before it") {
  const auto f = [](double t, const scalar_state&) { return scalar_state(t < 0.5 ? 1.0 : nan); };
  dormand_prince45 solver(f, 0.0, scalar_state(0.0));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0.49999") && contains_text("not a finite number"));
  CHECK(solver.state()[0] == within(solver.time(), 1e-14));  // tens of steps, each rounded by 1e-16
  CHECK(solver.statistics().rejected < 100);
  dormand_prince45 at_once(f, 0.7, scalar_state(3.0));
  CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));
  CHECK(at_once.state()[0] == 3.0);
  const auto later = [](double t, const scalar_state&) { return scalar_state(t == 0.0 ? 1.0 : inf); };
  dormand_prince45 from_zero(later, 0.0, scalar_state(3.0));
  CHECK_THROWS_WITH(from_zero.integrate(1), contains_text("t = 0:") && contains_text("not a finite number"));
}

TEST_CASE("too many steps") {
  const auto stiff = [](double t, const scalar_state& x) { return scalar_state(-1e6 * (x[0] - std::cos(t))); };
  dormand_prince45 solver(stiff, 0.0, scalar_state(0.0), {.max_steps = 1000});
  CHECK_THROWS_WITH(solver.integrate(10), contains_text("max_steps = 1000"));
  CHECK(solver.statistics().steps + solver.statistics().rejected == 1000);
  CHECK(solver.time() > 0);
  CHECK(solver.state()[0] == within(std::cos(solver.time()), 1e-5));  // x - cos t decays at once; tolerance 1e-6
}

TEST_CASE("one of the tolerances may be 0") {
  const Eigen::Vector2d x(1, 0);  // a component that is 0 at the start
  const auto error = [&](const tolerances<double>& tol) {
    dormand_prince45 solver(oscillator, 0.0, x, tol);
    solver.integrate(1);
    CHECK(solver.statistics().steps < 1000);
    return (solver.state() - Eigen::Vector2d(std::cos(1.0), -std::sin(1.0))).norm();
  };
  CHECK(error({.absolute = 1e-8, .relative = 0}) < 1e-6);  // less than 100 steps
  CHECK(error({.absolute = 0, .relative = 1e-8}) < 1e-6);
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.absolute = Eigen::Vector2d(1, 0), .relative = 0}),
                    contains_text("absolute and relative tolerance are both 0, of component 1"));
  const auto growth = [](double, const Eigen::Vector2d& y) { return Eigen::Vector2d(y[0], 0); };  // one stays 0
  dormand_prince45 solver(growth, 0.0, x, {.absolute = 0, .relative = 1e-8});
  solver.integrate(1);
  CHECK(solver.state()[0] == within(std::exp(1.0), 1e-6));
  CHECK(solver.state()[1] == 0);
}

TEST_CASE("tolerances that arithmetic cannot reach are refused, when they are") {
  const Eigen::Vector2d x(1, 0);
  for (double tiny : {1e-20, 1e-300}) {
    CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.absolute = 0, .relative = tiny}),
                      contains_text("relative tolerance ") &&
                          contains_text("of component 0 is out of reach of the arithmetic: 8.88"));
    for (double relative : {tiny, 0.0}) {
      if (tiny == 1e-300) {  // a tolerance for no number
        CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.absolute = tiny, .relative = relative}),
                          contains_text("relative tolerance " + detail::number(relative) +
                                        " of component 0 is out of reach of the arithmetic: 8.88"));
        continue;
      }
      dormand_prince45 solver(oscillator, 0.0, x, {.absolute = tiny, .relative = relative});
      CHECK_THROWS_WITH(solver.integrate(1), contains_text("stopped at t = 0: the tolerance ") &&
                                                 contains_text("of component 0, which is 1, is out of reach"));
      CHECK(solver.statistics().evaluations < 2);
    }
  }
  const auto rises = [](double, const scalar_state&) { return scalar_state(1.0); };
  dormand_prince45 later(rises, 0.0, scalar_state(0.0), {.absolute = 1e-18, .relative = 0});
  CHECK_THROWS_WITH(later.integrate(1), contains_text("is out of reach of the arithmetic"));
  CHECK(later.statistics().steps < 100);
  dormand_prince45 too_small(rises, 0.0, scalar_state(0.0), {.absolute = 1e-160, .relative = 1e-6});
  CHECK_THROWS_WITH(too_small.integrate(1),
                    contains_text("at t = 0: the tolerance 9.9999999999999999e-161 of component 0 is too small for its "
                                  "rate 1"));
  dormand_prince45 small(oscillator, 0.0, 1e-10 * x, {.absolute = 1e-20, .relative = 0});  // within reach of 1e-10
  small.integrate(1);
  CHECK(small.state()[0] == within(1e-10 * std::cos(1.0), 1e-18));
}

TEST_CASE("after a rejection the step does not grow at once") {
  detail::step_controller<double> control(5);
  CHECK(control.accepted(1e-8, true) == 1);
  CHECK(control.accepted(1e-8, false) > 5);
  // A force that jumps in the middle of long steps: rejected, and the step after is as long as that accepted at most.
  const auto jump = [](double t, const scalar_state& v) { return scalar_state((t < 0.7 ? 0.0 : 1.0) - 1e-3 * v[0]); };
  dormand_prince45 solver(jump, 0.0, scalar_state(0.0));
  solver.begin(10);
  double last = 0;
  bool after_rejection = false;
  int seen = 0;
  while (solver.time() != 10) {
    const double start = solver.time();
    const auto rejected = solver.statistics().rejected;
    solver.step(10);
    const double length = solver.time() - start;
    if (after_rejection) {
      CHECK(length < 1.02 * last);  // stretched by 1/100 before the end
      ++seen;
    }
    after_rejection = solver.statistics().rejected > rejected;
    last = length;
  }
  CHECK(seen > 0);
}

TEST_CASE("a failure is data, too") {
  const auto second_ends = [](double t, const Eigen::Vector2d&) { return Eigen::Vector2d(1, t < 0.5 ? 1.0 : nan); };
  dormand_prince45 solver(second_ends, 0.0, Eigen::Vector2d(0, 0));
  const auto failure = [](auto& s) {
    try {
      s.integrate(10);
    } catch (const integration_failure& e) {
      return e;
    }
    return integration_failure("none", 0, failure_reason::other);
  };
  const auto e = failure(solver);
  CHECK(e.reason == failure_reason::not_finite);
  CHECK(e.time == solver.time());
  CHECK(e.component == 1);
  CHECK(e.cause.empty());
  dormand_prince45 few(oscillator, 0.0, Eigen::Vector2d(1, 0), {.max_steps = 3});
  CHECK(failure(few).reason == failure_reason::too_many_steps);
  dormand_prince45 blow_up(square, 0.0, scalar_state(1.0));
  CHECK(failure(blow_up).reason == failure_reason::step_too_short);
}

TEST_CASE("bad settings are rejected with their value") {
  const Eigen::Vector2d x(1, 0);
  for (double bad : {-1e-6, nan, inf}) {
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.absolute = bad}), bad_argument);
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.relative = bad}), bad_argument);
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.initial_step = bad}), bad_argument);
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.smallest_step = bad}), bad_argument);
    CHECK_THROWS_AS(dormand_prince45(oscillator, 0.0, x, {.largest_step = bad}), bad_argument);
  }
  for (double bad : {0.0, -1e-6, nan, inf}) {
    dormand_prince45 solver(oscillator, 0.0, x);
    CHECK_THROWS_AS(solver.integrate(1, every(bad), [](double, const auto&) {}), bad_argument);
  }
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.relative = -0.25}),
                    contains_text("relative tolerance must be finite and not negative, got -0.25"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.initial_step = 0.5, .largest_step = 0.25}),
                    contains_text("initial step 0.5 is above the largest step 0.25"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, x, {.max_steps = 0}), contains_text("max_steps"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, nan, x), contains_text("start time must be finite, got nan"));
  CHECK_THROWS_WITH(dormand_prince45(oscillator, 0.0, Eigen::Vector2d(0, inf)), contains_text("start state"));
  dormand_prince45 solver(oscillator, 0.0, x);
  CHECK_THROWS_WITH(solver.integrate(nan), contains_text("end time must be finite, got nan"));
  CHECK(solver.time() == 0);
  dormand_prince45 early(oscillator, -1.5e308, x);
  CHECK_THROWS_WITH(early.integrate(1.5e308), contains_text("the way to the end time must be finite"));
}

}  // namespace integration_failure_test
