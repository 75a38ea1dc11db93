#include <kte/manipulators/rate_bounds.hpp>

#include "catch.hpp"
#include "random.hpp"

// Bounds of the rates of a joint, against steps of the motion itself.

namespace rate_bounds_test {

using namespace kte;

constexpr double none = std::numeric_limits<double>::infinity();

/// How far steps of deceleration a get from rate v, v > 0: the last ends at rest.
double way(double v, double a, double dt) {
  double d = 0;
  for (; v > 0; v -= a * dt) d += v * dt;
  return d;
}

TEST_CASE("the stopping rate is the largest that stops in time, exactly in discrete time") {
  random_numbers random(1);
  for (int i = 0; i < 2000; ++i) {
    const double a = std::exp(random(3)), dt = std::exp(random(3) - 3), d = std::exp(random(6) - 3);
    const double v = stopping_rate(d, a, dt), steps = v / (a * dt) + 1;
    REQUIRE(way(v, a, dt) == within(d, 4e-16 * steps * d));
    REQUIRE(way(v * (1 + 1e-9), a, dt) > d);
  }
  CHECK(stopping_rate(0.0, 3.0, 0.1) == 0);
  CHECK(stopping_rate(0.5, none, 0.1) == 5);  // in one step
  CHECK(stopping_rate(0.5, 0.0, 0.1) == 0);   // what cannot brake must not begin
  CHECK(stopping_rate(0.0, 0.0, 0.1) == 0);
  CHECK(stopping_rate(3.0, 1.0, 1.0) == 2);                   // 2 + 1
  CHECK(stopping_rate(2.0, 1.0, 1.0) == within(1.5, 1e-16));  // 1.5 + 0.5
  CHECK(stopping_rate(1e12, 1e-4, 1e-3) == within_relative(std::sqrt(2e8), 1e-10));
  CHECK(stopping_rate(1e12, 1e-320, 1e-3) > 0);
}

TEST_CASE("whatever is requested of a joint, its limits are kept to rounding and the bounds are never empty") {
  random_numbers random(2);
  const double lower = -2.0, upper = 1.7, rate = 2.5, dt = 0.01;
  for (const double a : {0.8, 5.0, 40.0, 1000.0, none}) {
    double q = 0, v = 0, wanted = 0;
    for (int i = 0; i < 100000; ++i) {
      if (i % 50 == 0) wanted = random(5);
      const auto b = rate_bounds(q, v, lower, upper, rate, a, dt);
      if (!(b.lower <= b.upper) || b.recovering) FAIL("empty at " << q << ", " << v << ", step " << i);
      const double next = std::min(std::max(wanted, b.lower), b.upper);
      if (!(std::abs(next - v) <= a * dt + 64 * 2.3e-16 * (5 + a * dt + 2 / dt)))
        FAIL("acceleration " << (next - v) / dt - a);
      v = next, q += v * dt;
      if (!(lower <= q && q <= upper && std::abs(v) <= rate)) FAIL("left its limits: " << q << ", " << v);
    }
  }
}

TEST_CASE("outside its limits, or too fast, a joint recovers with the acceleration it has") {
  const double upper = 1.0, a = 4.0, dt = 0.01;
  for (const bool outside : {true, false}) {
    double q = outside ? 1.5 : 0.9, v = outside ? 0.7 : 3.0;
    int steps = 0;
    for (auto b = rate_bounds(q, v, -1.0, upper, 2.0, a, dt); b.recovering && steps < 1000; ++steps) {
      REQUIRE(b.lower <= b.upper);
      REQUIRE(std::abs(b.upper - v) <= a * dt * (1 + 1e-12));
      v = b.upper, q += v * dt;
      b = rate_bounds(q, v, -1.0, upper, 2.0, a, dt);
    }
    CHECK(steps > 10);
    CHECK(steps < 300);
    CHECK(q <= upper);
    CHECK(q > upper - 0.01);  // and no further than it had to
  }
  CHECK(rate_bounds(1.5, 0.0, -1.0, 1.0, 2.0, none, 0.1).upper == -2);                 // as fast as it may
  CHECK(rate_bounds(1.1, 0.0, -1.0, 1.0, 2.0, none, 0.1).upper == within(-1, 1e-14));  // to the border
  CHECK(rate_bounds(0.5, 3.0, -none, none, 2.0, none, 0.1).upper == 2);
  CHECK(rate_bounds(0.0, 0.0, -1.0, 1.0, 2.0, 0.0, 0.1).upper == 0);
  CHECK(rate_bounds(2.0, 1.0, 2.0, 2.0, none, none, 0.1).upper == 0);  // no room at all
  // The same on the other side, and no bound is beyond the limit of the rate.
  CHECK(rate_bounds(1.5, 0.0, -1.0, 1.0, 2.0, none, 0.1).lower == -2);
  CHECK(rate_bounds(-1.5, 0.0, -1.0, 1.0, 2.0, none, 0.1).lower == 2);
  CHECK(rate_bounds(-1.5, 0.0, -1.0, 1.0, 2.0, none, 0.1).recovering);
  CHECK(rate_bounds(-0.9, -3.0, -1.0, 1.0, 2.0, 4.0, 0.01).lower == within(-2.96, 1e-15));
  CHECK(rate_bounds(-0.9, -3.0, -1.0, 1.0, 2.0, 4.0, 0.01).upper == within(-2.96, 1e-15));
  // A rate that is too fast by what rounding makes of it, of q and of v dt, is not; a little more is.
  for (const double sign : {1.0, -1.0}) {
    CHECK_FALSE(rate_bounds(0.0, sign * (2.04 + 1e-14), -9.0, 9.0, 2.0, 4.0, 0.01).recovering);
    CHECK(rate_bounds(0.0, sign * (2.04 + 2e-13), -9.0, 9.0, 2.0, 4.0, 0.01).recovering);
    CHECK_FALSE(rate_bounds(1.0, sign * (2.04 + 1e-12), -9.0, 9.0, 2.0, 4.0, 0.01).recovering);
    CHECK(rate_bounds(1.0, sign * (2.04 + 1e-11), -9.0, 9.0, 2.0, 4.0, 0.01).recovering);
    CHECK_FALSE(rate_bounds(0.0, sign * 2e3, -9.0, 9.0, 2.0, none, 0.01).recovering);
  }
  // Nor is a coordinate outside that is beyond its limit by rounding; the distance it keeps is as large.
  const double eps = std::numeric_limits<double>::epsilon();
  CHECK_FALSE(rate_bounds(1 + 2 * eps, 0.0, -1.0, 1.0, 2.0, 4.0, 0.01).recovering);
  CHECK(rate_bounds(1 + 8 * eps, 0.0, -1.0, 1.0, 2.0, 4.0, 0.01).recovering);
  CHECK(rate_bounds(1 - 2 * eps, 0.0, -1.0, 1.0, 2.0, 4.0, 0.01).upper == 0);
  CHECK(rate_bounds(1 - 8 * eps, 0.0, -1.0, 1.0, 2.0, 4.0, 0.01).upper > 0);
}

TEST_CASE("bounds of rates of numbers that are none are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using test::says;
  for (const double bad : {nan, none}) {
    CHECK_THROWS_MATCHES(rate_bounds(bad, 0.0, -1.0, 1.0, 2.0, 4.0, 0.1), bad_argument, says("the coordinate must be"));
    CHECK_THROWS_MATCHES(rate_bounds(0.0, bad, -1.0, 1.0, 2.0, 4.0, 0.1), bad_argument,
                         says("the rate before must be"));
    CHECK_THROWS_MATCHES(rate_bounds(0.0, 0.0, -1.0, 1.0, 2.0, 4.0, bad), bad_argument, says("the time of a step"));
  }
  for (const double bad : {nan, -1.0}) {
    CHECK_THROWS_MATCHES(rate_bounds(0.0, 0.0, 0.0, bad, 2.0, 4.0, 0.1), bad_argument, says("lower must not be above"));
    CHECK_THROWS_MATCHES(rate_bounds(0.0, 0.0, -1.0, 1.0, bad, 4.0, 0.1), bad_argument, says("the limit of the rate"));
    CHECK_THROWS_MATCHES(rate_bounds(0.0, 0.0, -1.0, 1.0, 2.0, bad, 0.1), bad_argument, says("the acceleration must"));
    CHECK_THROWS_MATCHES(stopping_rate(bad, 1.0, 0.1), bad_argument, says("a distance must not be negative"));
    CHECK_THROWS_AS(stopping_rate(1.0, bad, 0.1), bad_argument);
    CHECK_THROWS_AS(stopping_rate(1.0, 1.0, bad), bad_argument);
  }
  CHECK_THROWS_AS(rate_bounds(0.0, 0.0, nan, 1.0, 2.0, 4.0, 0.1), bad_argument);
  CHECK_THROWS_AS(stopping_rate(1.0, 1.0, 0.0), bad_argument);
  CHECK(rate_bounds(2.0, 1.0, 2.0, 2.0, none, none, 0.1).lower == 0);
}

}  // namespace rate_bounds_test
