#include "events/bouncing_ball.hpp"

#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include "catch.hpp"

// Impacts, peaks and flights against the closed form.

namespace bouncing_ball_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::bouncing;

template <class Solver>
void check_bounces(Solver solver) {
  const double e = 0.9;
  const auto report = integrate(solver, 15.0, events(ground(e), event(speed, crossing::falling)));
  REQUIRE(report.events.size() > 20);
  int impacts = 0, peaks = 0;
  for (const auto& found : report.events) {
    if (found.event == 0) {
      CHECK(found.time == within_relative(impact(e, impacts), 1e-13));
      CHECK(found.after[1] == within_relative(10 * std::pow(e, impacts + 1), 1e-12));
      ++impacts;
    } else {
      ++peaks;  // before all other impacts but the first
      CHECK(found.time == within_relative((impact(e, peaks - 1) + impact(e, peaks)) / 2, 1e-13));
      CHECK(found.before[0] == within_relative(5 * std::pow(e, 2 * peaks), 1e-12));
    }
  }
  CHECK(impact(e, impacts - 1) < 15);
  CHECK(impact(e, impacts) > 15);
  CHECK(solver.state()[0] == within(height_at(e, 15), 2e-12));
}

TEST_CASE("a bouncing ball: times, speeds and peaks") {
  SECTION("Kutta") { check_bounces(runge_kutta4(fall, 0.0, dropped, 0.1)); }
  SECTION("Kutta, long steps") { check_bounces(runge_kutta4(fall, 0.0, dropped, 7.0)); }
  SECTION("Butcher") { check_bounces(runge_kutta5(fall, 0.0, dropped, 0.03)); }
  SECTION("midpoint") { check_bounces(midpoint(fall, 0.0, dropped, 0.3)); }
  SECTION("Dormand and Prince") { check_bounces(dormand_prince45(fall, 0.0, dropped)); }
}

TEST_CASE("a bouncing ball by a method of order 1 bounces on the lines between its steps") {
  euler solver(fall, 0.0, dropped, 1e-4);
  const auto report = integrate(solver, 4.0, events(ground(0.5)));
  REQUIRE(report.events.size() > 5);
  for (int n = 0; n < 5; ++n) CHECK(report.events[static_cast<std::size_t>(n)].time == within(impact(0.5, n), 1e-3));
}

TEST_CASE("with event rows, samples are also those before and after a reset, and at it both") {
  const double e = 0.75;
  dormand_prince45 solver(fall, 0.0, dropped);
  int at_impact = 0;
  std::vector<double> times;
  const auto sampled_every = every(0.01).with_event_rows();
  const auto report = integrate(solver, 6.0, events(ground(e)), sampled_every, [&](double t, const ball_state& x) {
    REQUIRE(x[0] == within(height_at(e, t), 1e-12));
    if (!times.empty() && t == times.back()) ++at_impact;
    times.push_back(t);
  });
  CHECK(at_impact == report.count);
  CHECK(std::is_sorted(times.begin(), times.end()));
  std::size_t sampled = 0;
  for (double t : times) sampled += static_cast<std::size_t>(sampled < 600 && t == static_cast<double>(sampled) * 0.01);
  CHECK(sampled == 600);
  CHECK(times.back() == 6.0);
}

TEST_CASE("samples are at the times asked for, at events with the state after them") {
  dormand_prince45 bounces(fall, 0.0, dropped);
  std::vector<double> times;
  integrate(bounces, 6.0, events(ground(0.75)), at{0.5, 1.0, 1.0, 1.5},
            [&](double t, const ball_state&) { times.push_back(t); });
  CHECK(times == std::vector<double>{0.5, 1.0, 1.0, 1.5});

  const auto still = [](double, const ball_state&) { return ball_state(1, 0); };
  const auto half = event([](double t, const ball_state&) { return t - 0.5; });
  const auto step = half.reset([](double, ball_state& x) { x[0] += 1; });
  std::vector<double> seen;
  const auto keep = [&](double t, const ball_state& x) { seen.push_back(t), seen.push_back(x[0]); };
  const auto seen_of = [&](const auto& on, const auto& times_asked, double end) {
    dormand_prince45 solver(still, 0.0, ball_state(0, 0));
    seen.clear();
    integrate(solver, end, events(on), times_asked, keep);
    return seen;
  };
  using list = std::vector<double>;
  CHECK(seen_of(step, every(0.25), 1.0) == list{0, 0, 0.25, 0.25, 0.5, 1.5, 0.75, 1.75, 1, 2});
  CHECK(seen_of(step, every(0.5), 0.5) == list{0, 0, 0.5, 1.5});  // at the end
  CHECK(seen_of(step, every(0.25).with_event_rows(), 1.0) ==
        list{0, 0, 0.25, 0.25, 0.5, 0.5, 0.5, 1.5, 0.75, 1.75, 1, 2});
  CHECK(seen_of(step, at{0.5, 0.5}.with_event_rows(), 1.0) == list{0.5, 0.5, 0.5, 1.5, 0.5, 1.5});
  const auto stops = half.terminal();  // without a reset
  CHECK(seen_of(stops, at{0.25, 0.5, 0.75}, 1.0) == list{0.25, 0.25, 0.5, 0.5});
  CHECK(seen_of(stops, at{0.25, 0.5, 0.75}.with_event_rows(), 1.0) == list{0.25, 0.25, 0.5, 0.5});
  CHECK(seen_of(stops, at{0.25, 0.75}.with_event_rows(), 1.0) == list{0.25, 0.25, 0.5, 0.5});
  CHECK(seen_of(stops, at{0.25, 0.75}, 1.0) == list{0.25, 0.25});
  for (const auto& h : {every(0.4), every(0.4).with_event_rows()})  // with the end
    CHECK(seen_of(stops, h, 1.0) == list{0, 0, 0.4, 0.4, 0.5, 0.5});
  CHECK(seen_of(stops, every(0.5), 1.0) == list{0, 0, 0.5, 0.5});
  CHECK(seen_of(step.terminal(), every(0.4), 1.0) == list{0, 0, 0.4, 0.4, 0.5, 1.5});
}

TEST_CASE("observers of steps see both states at a reset") {
  runge_kutta4 solver(fall, 0.0, dropped, 0.3);
  std::vector<double> times, speeds;
  integrate(solver, 1.5, events(ground(0.5)),
            [&](double t, const ball_state& x) { times.push_back(t), speeds.push_back(x[1]); });
  REQUIRE(times.size() == 8);  // 0, 0.3, 0.6, 0.9, impact twice, two steps to 1.5
  CHECK(times[4] == times[5]);
  CHECK(times[4] == within(1.0, 1e-12));
  CHECK(speeds[4] == within(-10, 1e-12));
  CHECK(speeds[5] == within(5, 1e-12));
  CHECK(times[6] == within(1.3, 1e-12));
  CHECK(times[7] == 1.5);
}

TEST_CASE("an impact early in a long step is as exact as in a short one, and so are those after it") {
  dormand_prince45 solver(fall, 0.0, dropped);
  solver.integrate(1e7);
  solver.restart(0.0, dropped, keep_step);  // and tries a step to the end
  const auto report = integrate(solver, 1e6, events(ground(0.5)));
  CHECK(report.reason == stop_reason::zeno);
  REQUIRE(report.count == 40);
  for (std::size_t n = 0; n < 40; ++n)
    CHECK(report.events[n].time == within_relative(impact(0.5, static_cast<int>(n)), 1e-13));
}

}  // namespace bouncing_ball_test
