#include <kte/events/events.hpp>
#include <kte/integrators/dormand_prince45.hpp>

#include "catch.hpp"

// Mechanisms that change at events, whose solutions have a closed form.

namespace hybrid_systems_test {

using namespace kte;
using kte::test::within;
using kte::test::within_relative;

constexpr double pi = 3.14159265358979323846;
/// Place and speed.
using place = Eigen::Vector2d;

TEST_CASE("a ball between two walls") {
  const auto straight = [](double, const place& x) { return place(x[1], 0); };
  const auto turn = [](double, place& x) { x[1] = -x[1]; };
  const auto left = event([](double, const place& x) { return x[0] + 1; }).reset(turn);  // both directions, no set-back
  const auto right = event([](double, const place& x) { return x[0] - 1; }).reset(turn);
  for (double end : {1000.5, -1000.5}) {
    dormand_prince45 solver(straight, 0.0, place(0, 1));
    const auto report = integrate(solver, end, events(left, right));
    REQUIRE(report.count == 500);
    for (std::size_t i = 0; i < 500; ++i)
      CHECK(std::abs(report.events[i].time) == within_relative(1 + 2 * static_cast<double>(i), 1e-13));
    CHECK(solver.state()[0] == within(end > 0 ? 0.5 : -0.5, 1e-10));
  }
}

TEST_CASE("Coulomb friction: an oscillator comes to rest after a number of half swings") {
  // x'' = -100 x - 2 sign(x'): half swings of pi/10 s about -+0.02 m, each 0.04 m shorter, until |x| <= 0.02.
  for (double x0 : {1.0, 1.013, -0.99}) {
    int direction = x0 > 0 ? -1 : 1;  // 0: sticks
    const auto f = [&](double, const place& x) {
      return direction == 0 ? place(0, 0) : place(x[1], -100 * x[0] - 2 * direction);
    };
    const auto turns = event([](double, const place& x) { return x[1]; }).reset([&](double, place& x) {
      x[1] = 0;
      direction = std::abs(100 * x[0]) <= 2 ? 0 : x[0] > 0 ? -1 : 1;
    });
    dormand_prince45 solver(f, 0.0, place(x0, 0), {.absolute = 1e-14, .relative = 1e-14});
    const auto report = integrate(solver, 10.0, events(turns));
    double amplitude = std::abs(x0), side = x0 > 0 ? 1 : -1;
    std::size_t n = 0;
    while (amplitude > 0.02) {
      amplitude -= 0.04, side = -side, ++n;
      REQUIRE(report.events.size() >= n);
      CHECK(report.events[n - 1].time == within(static_cast<double>(n) * pi / 10, 1e-12));
      CHECK(report.events[n - 1].after[0] == within(side * amplitude, 1e-12));
    }
    CHECK(report.events.size() == n);
    CHECK(direction == 0);
    CHECK(solver.time() == 10);
    CHECK(solver.state()[0] == within(side * amplitude, 1e-12));
    CHECK(solver.state()[1] == 0);
  }
}

TEST_CASE("a block on a belt sticks and slips") {
  // m = 1 kg, k = 100 N/m, friction 3 N at rest, 2 N sliding, belt v = 0.05 m/s. It sticks until k x = 3 N, then slips
  // about 2 N / k with the amplitude 1 N / k and the speed v, until its speed is v again: w s = 2 pi - 2 atan(A w / v).
  const double v = 0.05, w = 10, amplitude = 0.01;
  const double slip = (2 * pi - 2 * std::atan(amplitude * w / v)) / w, stick = 2 * amplitude / v;
  bool sticks = true;
  const auto f = [&](double, const place& x) { return sticks ? place(v, 0) : place(x[1], 2 - 100 * x[0]); };
  const auto breaks =
      event([](double, const place& x) { return 100 * x[0] - 3; }, crossing::rising).reset([&](double, place&) {
        sticks = false;
      });
  const auto catches =
      event([&](double, const place& x) { return v - x[1]; }, crossing::falling).reset([&](double, place& x) {
        sticks = true;
        x[1] = v;
      });
  dormand_prince45 solver(f, 0.0, place(0.01, v), {.absolute = 1e-13, .relative = 1e-13});
  const auto report = integrate(solver, 10.0, events(breaks, catches));
  double t = 0;
  REQUIRE(report.events.size() > 20);
  for (std::size_t i = 0; i < report.events.size(); ++i) {
    t += i % 2 == 0 ? stick : slip;
    CHECK(report.events[i].event == i % 2);
    CHECK(report.events[i].time == within(t, 5e-12));
    CHECK(report.events[i].after[0] == within(i % 2 == 0 ? 0.03 : 0.01, 1e-12));
  }
}

TEST_CASE("backlash: a block between two springs with a gap") {
  // Free for |x| < 0.1, springs of 100 N/m beyond: half a swing of pi/10 s there, 0.2 m at 2 m/s between.
  const auto f = [](double, const place& x) {
    return place(x[1], x[0] > 0.1 ? -100 * (x[0] - 0.1) : x[0] < -0.1 ? -100 * (x[0] + 0.1) : 0);
  };
  const auto contact = [](double edge) { return event([=](double, const place& x) { return x[0] - edge; }).restart(); };
  dormand_prince45 solver(f, 0.0, place(0, 2), {.absolute = 1e-13, .relative = 1e-13});
  const auto report = integrate(solver, 8.0, events(contact(0.1), contact(-0.1)));
  // A step may change the speed of 2 m/s by 1e-13 (1 + 2) m/s, the place by 1.1e-13 m. Half swings take the same time
  // at any speed, but each 0.2 m between them 0.2 / 2^2 s more for each m/s less: errors of the speed, which stay, make
  // those of the times grow with every flight.
  double t = 0.05;
  const double error = 3e-13 * static_cast<double>(solver.statistics().steps);
  CHECK(error < 1e-8);
  REQUIRE(report.events.size() > 35);
  for (std::size_t i = 0; i < report.events.size(); ++i) {
    CHECK(report.events[i].event == (i / 2) % 2);
    CHECK(report.events[i].time == within(t, error * (0.05 * static_cast<double>(i / 2 + 1) + 0.2)));
    CHECK(std::abs(report.events[i].after[1]) == within(2, error));
    t += i % 2 == 0 ? pi / 10 : 0.1;
  }
}

}  // namespace hybrid_systems_test
