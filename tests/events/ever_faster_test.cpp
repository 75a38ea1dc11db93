#include <kte/integrators/dormand_prince45.hpp>

#include "catch.hpp"
#include "events/bouncing_ball.hpp"

// Infinitely many events before a time, and what comes after it.

namespace ever_faster_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::bouncing;

TEST_CASE("ever faster bounces stop, just before the time at which there are infinitely many") {
  for (double e : {0.1, 0.5, 0.9}) {
    dormand_prince45 solver(fall, 0.0, dropped);
    const auto report = integrate(solver, 1e7, events(ground(e)));
    CHECK(report.reason == stop_reason::zeno);
    CHECK(report.stopped_by == 0);
    CHECK(solver.time() == within_relative(1 + 2 * e / (1 - e), 1e-10));
    CHECK(solver.time() == report.events.back().time);
    CHECK(solver.state() == report.events.back().after);
    CHECK(solver.state()[0] >= 0);
    CHECK(static_cast<double>(report.count) < 3 + std::log(1e-12) / std::log(e));
    CHECK(solver.statistics().steps < 3 * report.count + 20);
    // An impact that is found d late, by up to 4 eps t, has a speed too large by g d: later ones are 2 e d / (1 - e)
    // late.
    const double end = 1 + 2 * e / (1 - e), late = 4 * std::numeric_limits<double>::epsilon() * end * end;
    for (std::size_t n = 0; n < report.events.size(); ++n)
      CHECK(report.events[n].time == within(impact(e, static_cast<int>(n)), late * static_cast<double>(n + 1)));
  }
  dormand_prince45 solver(fall, 0.0, dropped);
  const auto coarse = integrate(solver, 10.0, events(ground(0.5)).with({.shortest = 1e-3}));
  CHECK(coarse.reason == stop_reason::zeno);
  CHECK(coarse.count == 12);  // flights of 1, 1/2, ... 1/1024 s
}

TEST_CASE("infinitely many bounces hand over to rest, from which there is a way back") {
  bool lies = false;
  double pull = -10;
  const auto f = [&](double, const ball_state& x) { return ball_state(x[1], lies ? 0 : pull); };
  const auto floor = ground(0.5).rest([&](double, ball_state& x) {
    x = {0, 0};
    lies = true;
  });
  const auto kick = event([](double t, const ball_state&) { return t - 5; }).reset([&](double, ball_state& x) {
    lies = false;
    x[1] = 10;
  });
  dormand_prince45 solver(f, 0.0, dropped);
  const auto report = integrate(solver, 20.0, events(floor, kick));
  CHECK(report.reason == stop_reason::end_time);
  std::vector<double> rests;
  for (const auto& e : report.events)
    if (e.rest) rests.push_back(e.time);
  REQUIRE(rests.size() == 2);
  CHECK(rests[0] == within_relative(3, 1e-10));
  CHECK(rests[1] == within_relative(5 + 4, 1e-10));
  CHECK(solver.time() == 20);
  CHECK(solver.state() == ball_state(0, 0));
}

TEST_CASE("an impact that does not lift off is rest, where events are one-sided, or a stop") {
  bool lies = false;
  const auto f = [&](double, const ball_state& x) { return ball_state(x[1], lies ? 0 : -10); };
  for (double e : {0.0, 1e-9, 1e-6, 1e-3}) {
    for (double t_end : {4.0, 1e6}) {
      lies = false;
      dormand_prince45 stops(f, 0.0, dropped), rests = stops;
      const auto stopped = integrate(stops, t_end, events(ground(e).one_sided()));
      CHECK(stopped.reason == stop_reason::zeno);
      CHECK(stops.time() == within(1 + 2 * e, 5e-6));
      const auto handed_over = integrate(rests, t_end, events(ground(e).rest([&](double, ball_state& x) {
                                           x[1] = 0;
                                           lies = true;
                                         })));
      CHECK(handed_over.reason == stop_reason::end_time);
      CHECK(handed_over.events.back().rest);
      CHECK(handed_over.count <= 5);
      CHECK(rests.state() == ball_state(0, 0));
    }
  }
}

}  // namespace ever_faster_test
