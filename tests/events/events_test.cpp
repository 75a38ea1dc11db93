#include "events/oscillator.hpp"

namespace events_test {

using namespace kte;
using namespace kte::test::oscillating;
using kte::test::contains_text;
using kte::test::within;
using kte::test::within_relative;

// Which zeros are events, and in what order.

TEST_CASE("the zeros of an oscillator are found to the tolerance of the solution") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(0, 1), {.absolute = 1e-12, .relative = 1e-12});
  const auto report = integrate(solver, 32.0, events(event(position)));
  REQUIRE(report.events.size() == 10);
  CHECK(report.reason == stop_reason::end_time);
  for (std::size_t k = 0; k < 10; ++k) {
    const auto& e = report.events[k];
    CHECK(std::abs(e.time - static_cast<double>(k + 1) * pi) < 1e-12);
    CHECK(std::abs(e.before[0]) < 4 * eps * e.time);  // the slope is 1: zero as far as t resolves it
    CHECK(e.before == e.after);
  }
}

TEST_CASE("the state at an event is on the far side of zero, or at zero") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(0, 1));
  int side = 1;
  const auto found = integrate(solver, 1000.0, events(event(position))).events;
  CHECK(found.size() == 318);  // 318 pi = 999.03
  for (const auto& e : found) {
    CHECK(side * e.before[0] <= 0);
    side = -side;
  }
  CHECK(solver.statistics().steps < 10000);
}

TEST_CASE("two zeros within a step are found, however close, down to a millionth of it") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(0.01, 3.9);
  for (double width : {0.9, 0.5, 0.3, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 2e-6}) {
    for (int i = 0; i < 50; ++i) {
      const double a = anywhere(random), b = a + width, middle = a + width / 2;
      const auto square = events_of([=](double t) { return (t - a) * (t - b); }, 5);
      REQUIRE(square.size() == 2);
      CHECK(is_at(square[0].time, a));
      CHECK(is_at(square[1].time, b));
      const auto wave = events_of([=](double t) { return std::cos(width / 2) - std::cos(t - middle); }, 5);
      REQUIRE(wave.size() == 2);  // rounding of g: eps, against the slope sin(width / 2)
      CHECK(std::abs(wave[0].time - a) < 8 * eps * (a + 1 / width));
      CHECK(std::abs(wave[1].time - b) < 8 * eps * (b + 1 / width));
    }
  }
}

TEST_CASE("three zeros within a step, and those of a polynomial beyond the degree of the search") {
  const auto cubic = events_of([](double t) { return (t - 0.21) * (t - 0.22) * (t - 0.26); }, 1);
  REQUIRE(cubic.size() == 3);
  CHECK(is_at(cubic[1].time, 0.22));
  const auto chebyshev = [](double t) { return std::cos(9 * std::acos(2 * t - 1)); };
  const auto nine = events_of(chebyshev, 1);
  REQUIRE(nine.size() == 9);
  for (std::size_t k = 0; k < 9; ++k)
    CHECK(nine[k].time == within((1 - std::cos((static_cast<double>(k) + 0.5) * pi / 9)) / 2, 1e-14));
}

TEST_CASE("a g that waves within a step is searched in pieces") {
  const auto waves = [](double t) { return std::sin(100 * t + 0.1); };
  const auto found = events_of(waves, 10, {.pieces = 32});
  REQUIRE(found.size() == 318);
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(found[k].time == within((static_cast<double>(k + 1) * pi - 0.1) / 100, 1e-14));
  CHECK(events_of([](double t) { return std::sin(20 * t); }, 10).size() == 63);  // three waves need no pieces
}

TEST_CASE("a dip that is seen only as a misfit of the quartics is looked into") {
  for (double middle : {0.46, 0.465, 0.47}) {  // between two values; the first quartics stay positive
    const double half = 0.1 * std::sqrt(std::log(1.001));
    const auto dip = [=](double t) { return 1 - 1.001 * std::exp(-std::pow((t - middle) / 0.1, 2)); };
    const auto found = events_of(dip, 3);
    REQUIRE(found.size() == 2);
    CHECK(found[0].time == within(middle - half, 1e-13));
    CHECK(found[1].time == within(middle + half, 1e-13));
  }
}

TEST_CASE("touching zero is no crossing, reaching it and going on is one") {
  CHECK(events_of([](double t) { return (t - 0.5) * (t - 0.5); }, 4).empty());  // at a time that is looked at
  CHECK(events_of([](double t) { return (t - 1) * (t - 1); }, 4).empty());      // at the end of a step
  CHECK(events_of([](double t) { return -(t - 0.3) * (t - 0.3); }, 4).empty());
  CHECK(events_of([](double t) { return std::abs(t - 0.7); }, 4).empty());
  CHECK(events_of([](double) { return 0.0; }, 4).empty());
  for (double zero : {0.5, 1.0, 2.0, 2.125}) {
    const auto cubic = events_of([=](double t) { return (t - zero) * (t - zero) * (t - zero); }, 4);
    REQUIRE(cubic.size() == 1);
    CHECK(cubic[0].time == zero);
  }
  const auto and_back = events_of([](double t) { return (t - 1) * (t - 1.1); }, 4);
  REQUIRE(and_back.size() == 2);
  CHECK(and_back[0].time == 1);
  CHECK(is_at(and_back[1].time, 1.1));
  const auto plateau = events_of([](double t) { return std::max(0.0, 1.2 - t) - std::max(0.0, t - 2.3); }, 4);
  REQUIRE(plateau.size() == 1);
  CHECK(plateau[0].time >= 1.2);
  CHECK(plateau[0].time <= 2.3 + 4 * eps);
}

TEST_CASE("a crossing is at the first time beyond zero, to the ulp") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(0.001, 7.9);
  for (int i = 0; i < 50; ++i) {
    const double zero = anywhere(random);
    for (double slope : {1.0, -1e-30, 1e30}) {
      const auto line = events_of([=](double t) { return slope * (t - zero); }, 8);
      REQUIRE(line.size() == 1);
      CHECK(line[0].time >= zero);
      CHECK(line[0].time <= zero * (1 + 4 * eps));
    }
    const auto step = events_of([=](double t) { return t < zero ? -1.0 : 1.0; }, 8);  // not even continuous
    REQUIRE(step.size() == 1);
    CHECK(is_at(step[0].time, zero));
    const auto flat = events_of([=](double t) { return std::pow(t - zero, 9); }, 8);
    REQUIRE(flat.size() == 1);
    CHECK(is_at(flat[0].time, zero));
  }
  auto across_zero = in_long_steps(-0.7);
  const auto g = [](double t, const scalar&) { return t - 1e-9; };
  CHECK(integrate(across_zero, 1.0, events(event(g))).events[0].time == within_relative(1e-9, 1e-15));
}

TEST_CASE("directions are those of increasing time, also when integrated backward") {
  const auto g = [](double t, const scalar&) { return std::sin(t); };
  const auto list =
      events(event(g, crossing::rising), event(g, crossing::falling), event(g), event(g, crossing::rising));
  auto forward = in_long_steps(1), backward = in_long_steps(20);
  auto there = integrate(forward, 20.0, list).events;
  auto back = integrate(backward, 1.0, list).events;
  REQUIRE(there.size() == 3 + 3 + 6 + 3);
  REQUIRE(back.size() == there.size());
  CHECK(std::is_sorted(there.begin(), there.end(), [](auto& a, auto& b) { return a.time < b.time; }));
  CHECK(std::is_sorted(back.begin(), back.end(), [](auto& a, auto& b) { return a.time > b.time; }));
  for (const auto& found : {there, back})
    for (const auto& e : found) {
      const double turns = e.time / pi;
      CHECK(turns == within_relative(std::round(turns), 4 * eps));
      if (e.event == 1) CHECK(std::fmod(std::round(turns), 2) == 1);
      if (e.event == 0 || e.event == 3) CHECK(std::fmod(std::round(turns), 2) == 0);
    }
}

TEST_CASE("events of one step come in the order of time, those of one time in the order of the list") {
  auto solver = in_long_steps();
  const auto at = [](double zero) { return event([=](double t, const scalar&) { return t - zero; }); };
  const auto third = event([](double t, const scalar&) { return 3 * t - 0.6; });
  const auto list = events(at(0.3), at(0.2), at(0.1), third, at(0.2));
  const auto report = integrate(solver, 1.0, list), back = integrate(solver, 0.0, list);
  std::vector<std::size_t> order, order_back;
  for (const auto& e : report.events) order.push_back(e.event);
  for (const auto& e : back.events) order_back.push_back(e.event);
  CHECK(order == std::vector<std::size_t>{2, 1, 3, 4, 0});
  CHECK(order_back == std::vector<std::size_t>{0, 1, 3, 4, 2});
  REQUIRE(report.events.size() == 5);
  CHECK(report.events[1].time == report.events[3].time);
}

TEST_CASE("resets of one time are called one after the other") {
  auto solver = in_long_steps();
  const auto g = [](double t, const scalar&) { return t - 1.5; };
  const auto add = event(g).reset([](double, scalar& x) { x[0] += 1; });
  const auto twice = event(g).reset([](double, scalar& x) { x[0] *= 2; });
  const auto report = integrate(solver, 4.0, events(add, twice, event(g)));
  REQUIRE(report.events.size() == 3);
  CHECK(report.events[0].before[0] == within(1.5, 8 * eps));
  CHECK(report.events[0].after[0] == within(2.5, 8 * eps));
  CHECK(report.events[1].before[0] == within(2.5, 8 * eps));
  CHECK(report.events[1].after[0] == within(5, 16 * eps));
  CHECK(report.events[2].before == report.events[1].after);
  CHECK(solver.state()[0] == within(7.5, 16 * eps));
  CHECK(solver.time() == 4);
}

TEST_CASE("a reset that takes another function across zero is no event of that one, going on from there may be") {
  auto solver = in_long_steps();
  const auto jump = event([](double t, const scalar&) { return t - 1.5; }).reset([](double, scalar& x) { x[0] = 10; });
  const auto beyond = event([](double, const scalar& x) { return x[0] - 5; });
  const auto onto = event([](double, const scalar& x) { return x[0] - 10; });
  const auto later = event([](double, const scalar& x) { return x[0] - 11; });
  const auto report = integrate(solver, 4.0, events(jump, beyond, onto, later));
  REQUIRE(report.events.size() == 2);
  CHECK(report.events[1].event == 3);
  CHECK(report.events[1].time == within(2.5, 8 * eps));
}

TEST_CASE("zero at the start is no event") {
  const auto still = events_of([](double t) { return t; }, 3);
  CHECK(still.empty());
  const auto back = events_of([](double t) { return t * (0.1 - t); }, 3);
  REQUIRE(back.size() == 1);
  CHECK(is_at(back[0].time, 0.1));
  const auto soon = events_of([](double t) { return t * (t - 1e-9); }, 3);
  REQUIRE(soon.size() == 1);
  CHECK(is_at(soon[0].time, 1e-9));
}

TEST_CASE("zero at exactly the end is an event, once") {
  auto solver = in_long_steps();
  const auto list = events(event([](double t, const scalar&) { return t - 2.5; }));
  CHECK(integrate(solver, 2.5, list).events.at(0).time == 2.5);
  CHECK(integrate(solver, 4.0, list).events.empty());
  CHECK(integrate(solver, 2.5, list).events.size() == 1);  // backward
  CHECK(integrate(solver, 2.0, list).events.empty());
  auto early = in_long_steps();
  CHECK(integrate(early, std::nextafter(2.5, 0.0), list).events.empty());
  CHECK(integrate(early, 3.0, list).events.size() == 1);
}

TEST_CASE("a terminal event ends the integration there, and does not come again") {
  dormand_prince45 solver(oscillator, 0.0, Eigen::Vector2d(0, 1), {.absolute = 1e-12, .relative = 1e-12});
  const auto unused = event([](double t, const auto&) { return t - 100; });
  const auto list = events(unused, event(position).named("middle").terminal());
  for (int k = 1; k <= 5; ++k) {
    const auto report = integrate(solver, 50.0, list);
    CHECK(report.reason == stop_reason::terminal);
    CHECK(report.stopped_by == 1);
    CHECK(report.stopped_by_name == "middle");
    REQUIRE(report.events.size() == 1);
    CHECK(solver.time() == report.events[0].time);
    CHECK(solver.state() == report.events[0].after);
    CHECK(solver.time() == within(k * pi, 2e-12));
  }
}

TEST_CASE("events that do not act do not change the steps") {
  dormand_prince45 plain(oscillator, 0.0, Eigen::Vector2d(1, 0)), watched = plain;
  std::vector<double> steps, seen;
  plain.integrate(30, [&](double t, const auto&) { steps.push_back(t); });
  const auto report =
      integrate(watched, 30.0, events(event(position)), [&](double t, const auto&) { seen.push_back(t); });
  CHECK(report.events.size() == 10);
  CHECK(steps == seen);
  CHECK(plain.state() == watched.state());
  CHECK(plain.statistics().evaluations == watched.statistics().evaluations);
}

TEST_CASE("a step without events takes eight values of g along it, and one at its end") {
  long long values = 0;
  auto solver = in_long_steps();
  const auto count = event([&](double t, const scalar&) { return ++values, 200 - t; });
  integrate(solver, 100.0, events(count));
  CHECK(values == 1 + 100 * 9 + 1);  // and the start, and whether it ends at zero
}

}  // namespace events_test
