#include <kte/events/events.hpp>
#include <kte/integrators/bogacki_shampine23.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/fehlberg45.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "catch.hpp"

// Systems with events whose solutions have a closed form.

using namespace kte;
using kte::test::contains_text;
using kte::test::within;
using kte::test::within_relative;

namespace {

constexpr double pi = 3.14159265358979323846;
using ball_state = Eigen::Vector2d;

/// A ball falls from 5 m at 10 m/s^2: it hits the ground at 1 s with 10 m/s. With restitution e flights last 2 e, 2
/// e^2,
/// ...
const ball_state dropped(5, 0);
constexpr auto fall = [](double, const ball_state& x) { return ball_state(x[1], -10); };
constexpr auto height = [](const auto&, const auto& x) { return x[0]; };
constexpr auto speed = [](const auto&, const auto& x) { return x[1]; };
auto bounce(double e) {
  return [e](double, ball_state& x) { x = {0, -e * x[1]}; };
}
auto ground(double e) { return event(height, crossing::falling).reset(bounce(e)); }
/// Of the impact n, from 0.
double impact(double e, int n) { return 1 + 2 * e * (1 - std::pow(e, n)) / (1 - e); }
double height_at(double e, double t) {
  if (t <= 1) return 5 - 5 * t * t;
  int n = 0;
  while (n < 200 && impact(e, n + 1) <= t) ++n;
  const double s = t - impact(e, n);
  return 10 * std::pow(e, n + 1) * s - 5 * s * s;
}

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

}  // namespace

TEST_CASE("A bouncing ball: times, speeds and peaks") {
  SECTION("Kutta") { check_bounces(runge_kutta4(fall, 0.0, dropped, 0.1)); }
  SECTION("Kutta, long steps") { check_bounces(runge_kutta4(fall, 0.0, dropped, 7.0)); }
  SECTION("Butcher") { check_bounces(runge_kutta5(fall, 0.0, dropped, 0.03)); }
  SECTION("midpoint") { check_bounces(midpoint(fall, 0.0, dropped, 0.3)); }
  SECTION("Bogacki and Shampine") { check_bounces(bogacki_shampine23(fall, 0.0, dropped)); }
  SECTION("Fehlberg") { check_bounces(fehlberg45(fall, 0.0, dropped)); }
  SECTION("Dormand and Prince") { check_bounces(dormand_prince45(fall, 0.0, dropped)); }
}

TEST_CASE("A bouncing ball by a method of order 1 bounces on the lines between its steps") {
  euler solver(fall, 0.0, dropped, 1e-4);
  const auto report = integrate(solver, 4.0, events(ground(0.5)));
  REQUIRE(report.events.size() > 5);
  for (int n = 0; n < 5; ++n) CHECK(report.events[static_cast<std::size_t>(n)].time == within(impact(0.5, n), 1e-3));
}

TEST_CASE("Samples are those before and after a reset, and at it both") {
  const double e = 0.75;
  dormand_prince45 solver(fall, 0.0, dropped);
  int at_impact = 0;
  std::vector<double> times;
  const auto report = integrate(solver, 6.0, events(ground(e)), every(0.01), [&](double t, const ball_state& x) {
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

  dormand_prince45 on_a_sample([](double, const ball_state&) { return ball_state(1, 0); }, 0.0, ball_state(0, 0));
  std::vector<double> seen;
  integrate(on_a_sample, 1.0, events(event([](double t, const ball_state&) {
                                       return t - 0.5;
                                     }).reset([](double, ball_state& x) { x[0] += 1; })),
            every(0.25), [&](double t, const ball_state& x) { seen.push_back(t), seen.push_back(x[0]); });
  CHECK(seen == std::vector<double>{0, 0, 0.25, 0.25, 0.5, 0.5, 0.5, 1.5, 0.75, 1.75, 1, 2});
}

TEST_CASE("Observers of steps see both states at a reset") {
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

TEST_CASE("Ever faster bounces stop, just before the time at which there are infinitely many") {
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

TEST_CASE("An impact early in a long step is as exact as in a short one, and so are those after it") {
  dormand_prince45 solver(fall, 0.0, dropped);
  solver.integrate(1e7);
  solver.restart(0.0, dropped, keep_step);  // and tries a step to the end
  const auto report = integrate(solver, 1e6, events(ground(0.5)));
  CHECK(report.reason == stop_reason::zeno);
  REQUIRE(report.count == 40);
  for (std::size_t n = 0; n < 40; ++n)
    CHECK(report.events[n].time == within_relative(impact(0.5, static_cast<int>(n)), 1e-13));
}

TEST_CASE("Infinitely many bounces hand over to rest, from which there is a way back") {
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

TEST_CASE("An impact that does not lift off is rest, where events are one-sided, or a stop") {
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

TEST_CASE("A ball between two walls") {
  const auto straight = [](double, const ball_state& x) { return ball_state(x[1], 0); };
  const auto turn = [](double, ball_state& x) { x[1] = -x[1]; };
  const auto left =
      event([](double, const ball_state& x) { return x[0] + 1; }).reset(turn);  // both directions, no set-back
  const auto right = event([](double, const ball_state& x) { return x[0] - 1; }).reset(turn);
  for (double end : {1000.5, -1000.5}) {
    dormand_prince45 solver(straight, 0.0, ball_state(0, 1));
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
    const auto f = [&](double, const ball_state& x) {
      return direction == 0 ? ball_state(0, 0) : ball_state(x[1], -100 * x[0] - 2 * direction);
    };
    const auto turns = event(speed).reset([&](double, ball_state& x) {
      x[1] = 0;
      direction = std::abs(100 * x[0]) <= 2 ? 0 : x[0] > 0 ? -1 : 1;
    });
    dormand_prince45 solver(f, 0.0, ball_state(x0, 0), {.absolute = 1e-14, .relative = 1e-14});
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

TEST_CASE("A block on a belt sticks and slips") {
  // m = 1 kg, k = 100 N/m, friction 3 N at rest, 2 N sliding, belt v = 0.05 m/s. It sticks until k x = 3 N, then slips
  // about 2 N / k with the amplitude 1 N / k and the speed v, until its speed is v again: w s = 2 pi - 2 atan(A w / v).
  const double v = 0.05, w = 10, amplitude = 0.01;
  const double slip = (2 * pi - 2 * std::atan(amplitude * w / v)) / w, stick = 2 * amplitude / v;
  bool sticks = true;
  const auto f = [&](double, const ball_state& x) {
    return sticks ? ball_state(v, 0) : ball_state(x[1], 2 - 100 * x[0]);
  };
  const auto breaks = event([](double, const ball_state& x) { return 100 * x[0] - 3; }, crossing::rising)
                          .reset([&](double, ball_state&) { sticks = false; });
  const auto catches =
      event([&](double, const ball_state& x) { return v - x[1]; }, crossing::falling).reset([&](double, ball_state& x) {
        sticks = true;
        x[1] = v;
      });
  dormand_prince45 solver(f, 0.0, ball_state(0.01, v), {.absolute = 1e-13, .relative = 1e-13});
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

TEST_CASE("Backlash: a block between two springs with a gap") {
  // Free for |x| < 0.1, springs of 100 N/m beyond: half a swing of pi/10 s there, 0.2 m at 2 m/s between.
  const auto f = [](double, const ball_state& x) {
    return ball_state(x[1], x[0] > 0.1 ? -100 * (x[0] - 0.1) : x[0] < -0.1 ? -100 * (x[0] + 0.1) : 0);
  };
  const auto contact = [](double edge) {
    return event([=](double, const ball_state& x) { return x[0] - edge; }).restart();
  };
  dormand_prince45 solver(f, 0.0, ball_state(0, 2), {.absolute = 1e-13, .relative = 1e-13});
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

namespace {

/// A disc that turns at a steady rate: the state is cos, sin and rate, of which only the first two make a rotation.
struct disc {
  using rate = ball_state;
  Eigen::Vector2d operator()(double, const Eigen::Vector3d& x) const { return {x[2], 0}; }
  Eigen::Index rates() const { return 2; }
  void displace(const Eigen::Vector3d& x, const rate& d, Eigen::Vector3d& out) const {
    const double c = std::cos(d[0]), s = std::sin(d[0]);
    out = {x[0] * c - x[1] * s, x[0] * s + x[1] * c, x[2] + d[1]};
  }
  void pull_back(const rate&, rate&) const {}
  void magnitudes(const Eigen::Vector3d& x, rate& m) const { m = {1, x[2]}; }
};

}  // namespace

TEST_CASE("Events of states with rotations: a disc that strikes turns back") {
  const auto upright = event([](double, const Eigen::Vector3d& x) {
                         return x[0];
                       }).reset([](double, Eigen::Vector3d& x) { x[2] *= -0.5; });
  dormand_prince45 solver(disc{}, 0.0, Eigen::Vector3d(1, 0, 1));
  const auto report = integrate(solver, 50.0, events(upright));
  double t = pi / 2, w = 1;
  REQUIRE(report.count == 4);  // at 90, -90, ... degrees, ever slower
  for (const auto& e : report.events) {
    CHECK(e.time == within_relative(t, 1e-14));
    CHECK(e.before.head<2>().norm() == within_relative(1, 1e-15));
    w /= 2;
    t += pi / w;
  }
}

TEST_CASE("Events in every scalar, and of dynamic states") {
  const auto check = [](auto one, double accuracy) {
    using S = decltype(one);
    using state = Eigen::Matrix<S, 2, 1>;
    const auto g = [](const S&, const state& x) { return S(x[0]); };
    const auto f = [](const S&, const state& x) { return state(x[1], S(-10)); };
    const auto back = [](const S&, state& x) { x[1] = -x[1] / 2; };
    dormand_prince45 solver(f, S(0), state(S(5), S(0)));
    const auto report = integrate(solver, S(2.75), events(event(g).reset(back)));
    REQUIRE(report.count >= 3);
    CHECK(std::abs(static_cast<double>(report.events[0].time - 1)) < accuracy);
    CHECK(std::abs(static_cast<double>(report.events[1].time - 2)) < accuracy);
    CHECK(std::abs(static_cast<double>(report.events[2].time - S(2.5))) < 3 * accuracy);
  };
  check(1.0f, 1e-6);
  check(1.0, 3e-15);
  check(1.0l, 2e-18);
  check(boost::multiprecision::cpp_bin_float_50(1), 1e-47);

  const auto f = [](double, const Eigen::VectorXd& x) -> Eigen::VectorXd { return Eigen::VectorXd::Ones(x.size()); };
  dormand_prince45 solver(f, 0.0, Eigen::VectorXd(Eigen::VectorXd::Zero(5)));
  const auto report = integrate(solver, 3.0, events(event([](double, const auto& x) { return x[4] - 1.25; })));
  CHECK(report.events.at(0).time == within_relative(1.25, 1e-15));
}

TEST_CASE("Late times are resolved to their ulp") {
  const auto f = [](double, const ball_state&) { return ball_state(1, 0); };
  dormand_prince45 solver(f, 1e9, ball_state(-0.7, 0));
  const auto report = integrate(solver, 1e9 + 1, events(event(height)));
  CHECK(report.events.at(0).time == within_relative(1e9 + 0.7, 4e-16));
}
