#include "events/oscillator.hpp"

namespace stopping_test {

using namespace kte;
using namespace kte::test::oscillating;
using kte::test::contains_text;
using kte::test::within;
using kte::test::within_relative;

// What throws or stops at an event, and where the solver then stands.

TEST_CASE("where a function of an event is not a number, or settings are invalid, that is said") {
  auto solver = in_long_steps();
  const auto good = event([](double t, const scalar&) { return t + 1; });
  const auto bad = event([](double t, const scalar&) { return std::sqrt(2.2 - t); });
  CHECK_THROWS_WITH(integrate(solver, 4.0, events(good, bad)),
                    contains_text("event 1 is not a finite number") && contains_text("t = 2."));
  CHECK_THROWS_AS(integrate(solver, std::nan(""), events(good)), bad_argument);
  CHECK_THROWS_WITH(integrate(solver, 4.0, events(good).with({.pieces = 0})), contains_text("pieces"));
  CHECK_THROWS_WITH(integrate(solver, 4.0, events(good).with({.pieces = 1 << 30})), contains_text("pieces"));
  CHECK_THROWS_WITH(integrate(solver, 4.0, events(good).with({.depth = -1})), contains_text("depth"));
  const auto to_nan =
      event([](double t, const scalar&) { return t - 3.5; }).reset([](double, scalar& x) { x[0] = std::nan(""); });
  auto other = in_long_steps();
  try {
    integrate(other, 4.0, events(to_nan.named("wall")));
    FAIL();
  } catch (const integration_failure& e) {
    CHECK_THAT(e.what(), contains_text("kte: integration stopped before t = 3.5") &&
                             contains_text(": the reset of event 0 'wall' makes the state not finite"));
    CHECK(e.time == within(3.5, 1e-15));
    CHECK(e.reason == failure_reason::not_finite);
    CHECK(e.cause == "wall");
    CHECK(e.component == 0);
  }
  CHECK(other.time() == 3);  // the start of the step, before the event
  CHECK(other.state()[0] == within(3, 8 * eps));
}

TEST_CASE("where a function of an event throws, only what has not been handled happens again") {
  auto solver = in_long_steps();
  std::vector<std::size_t> seen;
  bool broken = true;
  const auto at = [](double zero) { return event([=](double t, const scalar&) { return t - zero; }); };
  const auto breaks = at(2.5).reset([&](double, scalar& x) {
    if (broken) throw 42;
    x[0] += 1;
  });
  const auto list = events(at(2.25), breaks, at(2.75)).report_to([&](const auto& e) { seen.push_back(e.event); });
  CHECK_THROWS_AS(integrate(solver, 4.0, list), int);
  CHECK(seen == std::vector<std::size_t>{0});
  CHECK(solver.time() == 2.25);
  CHECK(solver.state()[0] == 2.25);
  broken = false;
  integrate(solver, 4.0, list);
  CHECK(seen == std::vector<std::size_t>{0, 1, 2});
  CHECK(solver.state()[0] == 5);
  std::vector<double> times;  // an observer of steps may throw as well: the step is done
  CHECK_THROWS_AS(integrate(solver, 8.0, events(at(100)),
                            [&](double t, const scalar&) {
                              times.push_back(t);
                              if (t == 6) throw 42;
                            }),
                  int);
  CHECK(solver.time() == 6);
}

TEST_CASE("events go to a function instead of a list, and too many stop") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0));
  std::size_t seen = 0;
  const auto list =
      events(event(position)).report_to([&](const event_occurrence<Eigen::Vector2d>& e) { seen += e.event + 1; });
  const auto report = integrate(solver, 100.0, list);
  CHECK(report.events.empty());
  CHECK(report.count == 32);
  CHECK(seen == 32);
  const auto most = integrate(solver, 1000.0, events(event(position)).with({.most = 9}));
  CHECK(most.reason == stop_reason::zeno);
  CHECK(most.events.size() == 10);
  CHECK(solver.time() == most.events.back().time);
}

TEST_CASE("an observer stops an integration with events after the event that it sees, or at a sample before it") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(1, 0));
  const auto bounce = events(event(position).named("wall").reset([](double, auto& x) { x[1] = -x[1]; }));
  const auto until = [](double end) { return [end](double t, const auto&) { return t < end; }; };
  auto report = solver.integrate(10, bounce, every(0.1).with_event_rows(), until(1.55));
  CHECK(report.reason == stop_reason::observer);
  CHECK(report.count == 1);  // at pi / 2, where it has seen the state before
  CHECK(solver.state()[1] > 0);
  solver.restart(0, Eigen::Vector2d(1, 0));
  report = solver.integrate(10, bounce, at{0.5, 1.5}, until(1.5));
  CHECK(report.count == 0);
  CHECK(solver.time() == 1.5);
  report = solver.integrate(2, bounce);
  CHECK(report.find("wall")->time == test::within(std::acos(0.0), 1e-5));
}

}  // namespace stopping_test
