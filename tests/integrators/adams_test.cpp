#include <kte/integrators/adams.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "catch.hpp"
#include "integrators/two_oscillators.hpp"

namespace adams_test {

using namespace kte;
using namespace kte::test;

template <class S>
using scalar_state = Eigen::Matrix<S, 1, 1>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Slopes t^m at random times, 0.5 to 2 apart, and then one more.
struct monomial_history {
  detail::adams_differences<scalar_state<real50>> past{scalar_state<real50>(0)};
  std::vector<real50> times;

  monomial_history(int m, int slopes, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> gap(0.5, 2);
    for (int i = 0; i <= slopes; ++i)
      times.push_back(i == 0 ? real50(-slopes) / 2 : real50(times.back() + gap(random)));
    past.start(times[0], slope(m, times[0]));
    for (int i = 1; i < slopes; ++i) {
      past.aim(time(i), past.known());
      past.offer(slope(m, time(i)));
      past.append(time(i));
    }
  }
  static scalar_state<real50> slope(int m, const real50& t) { return scalar_state<real50>(pow(t, m)); }
  /// The integral of the slopes, over its length.
  static real50 mean(int m, const real50& a, const real50& b) {
    return (pow(b, m + 1) - pow(a, m + 1)) / ((m + 1) * (b - a));
  }
  const real50& time(int i) const { return times[static_cast<std::size_t>(i)]; }
};

TEST_CASE("Adams: with any spacing, the formulas are exact for the polynomials of their order, and for no others") {
  scalar_state<real50> mean(0);
  const real50 rounding = 1e-35;  // of 50 digits, after products of 13 times
  for (int k = 1; k <= 12; ++k)
    for (int m = 0; m <= k + 1; ++m) {
      const int n = k + 1;  // slopes known, the newest at time n - 1; the step goes to time n
      monomial_history h(m, n, static_cast<unsigned>(100 * k + m));
      const real50 &t0 = h.time(n - 1), t = h.time(n), exact = h.mean(m, t0, t);
      h.past.aim(t, k);
      const real50 f = h.slope(m, t)[0], size = 1 + abs(f) + abs(exact);
      const real50 slope = h.past.slope()[0], predicted = h.past.mean()[0];
      CHECK((abs(slope - f) < rounding * size) == (m < k));
      CHECK((abs(predicted - exact) < rounding * size) == (m < k));  // (1) of adams: order k
      const real50 e = f - slope, corrected = predicted + h.past.g(k) * e;
      CHECK((abs(corrected - exact) < rounding * size) == (m < k + 1));  // (3): order k + 1
      const real50 lower = corrected - (h.past.g(k) - h.past.g(k - 1)) * e;
      CHECK((abs(lower - exact) < rounding * size) == (m < k));  // (4): the difference to order k
      h.past.offer(h.slope(m, t));
      h.past.append(t);
      const real50 middle = (3 * t0 + t) / 4;
      h.past.interpolate(middle - t0, k + 1, mean);
      CHECK((abs(mean[0] - h.mean(m, t0, middle)) < rounding * size) == (m < k + 1));
    }
}

TEST_CASE("Adams: the means that make the formulas are exact to degree 15, and no further, in any arithmetic") {
  const detail::gauss_rule<real50> rule;
  const auto zero = [](int) { return real50(0); };
  const auto one = [](int) { return real50(1); };
  rule.average_products(16, zero, one, [](int j, const real50& mean) {  // of u^j
    CHECK((abs(mean * (j + 1) - 1) < 1e-45) == (j <= 15));
  });
}

TEST_CASE("Adams: the next step and its order") {
  const auto next = [](double same, double lower, double higher) {
    const auto square = [](double e) { return e * e; };
    int order = 4;
    const double h = detail::adams_errors<double>{square(same), square(lower), square(higher)}.next_step(1, 1, order);
    return std::pair(h, order);
  };
  const double none = std::numeric_limits<double>::infinity();
  const auto is = [](std::pair<double, int> found, double step, int order) {
    return found.second == order && found.first == within_relative(step, 1e-3);
  };
  CHECK(is(next(0.05, none, none), std::pow(10, 0.2), 4));
  CHECK(is(next(0.9, none, none), std::pow(1.8, -0.2), 4));
  CHECK(is(next(0.3, none, none), 1, 4));
  CHECK(is(next(1e-9, none, none), 2, 4));
  CHECK(is(next(0, 0, 0), 2, 3));
  CHECK(is(next(0.2, 0.1, none), std::pow(5, 0.25), 3));
  CHECK(is(next(0.2, none, 0.02), std::pow(25, 1 / 6.), 5));
  int order = 4;
  CHECK(detail::adams_errors<double>{nan}.shorter_step(1, order) == within_relative(0.1, 1e-6));
  CHECK(detail::adams_errors<double>{4.0, 1.0}.shorter_step(1, order) == 0.5);
  CHECK(order == 3);
}

TEST_CASE("Adams: the error follows the tolerance, with few evaluations") {
  const auto solve = [](double tolerance) {
    adams solver(pendulum, 0.0, horizontal<double>(), {.absolute = tolerance, .relative = tolerance});
    solver.integrate(10);
    CHECK(std::abs(solver.state()[0] - theta10) < 50 * tolerance);  // near a turning point
    solver.integrate(50);
    const double error = std::abs(solver.state()[0] - theta50);
    CHECK(error < 10000 * tolerance);  // errors of the energy act on the phase with the square of the time
    UNSCOPED_INFO(tolerance << ": error " << error << ", evaluations " << solver.statistics().evaluations);
    return std::pair(error, solver.statistics().evaluations);
  };
  CHECK(solve(1e-6).second < 3500);   // dormand_prince45: 4600
  CHECK(solve(1e-9).second < 6000);   // 16000
  CHECK(solve(1e-12).second < 9500);  // 64000
}

TEST_CASE("Adams: the order goes up to 12 as the tolerance asks, and two evaluations make a step") {
  const auto order_at = [](double tolerance) {
    adams solver(pendulum, 0.0, horizontal<double>(), {.absolute = tolerance, .relative = tolerance});
    int most = 0;
    solver.integrate(50, [&](double, const auto&) { most = std::max(most, solver.order()); });
    const auto& cost = solver.statistics();
    // One tells that a step is to be rejected. Near rounding now and then one tells what that makes of f.
    const auto more = cost.evaluations - (2 + 2 * cost.steps + cost.rejected);
    CHECK(more >= 0);
    CHECK(more <= (tolerance < 1e-10 ? (cost.steps + cost.rejected) / 32 : 0));
    return most;
  };
  CHECK(order_at(1e-2) < 8);
  CHECK(order_at(1e-12) == 12);
}

TEST_CASE("Adams: between the ends of steps the error is that at the ends") {
  for (double tolerance : {1e-4, 1e-7, 1e-10, 1e-13}) {
    adams solver(oscillator, 0.0, state<double>(1, 0), {.absolute = tolerance, .relative = tolerance});
    auto sampled = solver;
    double at_ends = 0, between = 0;
    const auto error = [](double t, const state<double>& x) {
      return (x - state<double>(std::cos(t), -std::sin(t))).norm();
    };
    solver.integrate(20, [&](double t, const auto& x) { at_ends = test::worse(at_ends, error(t, x)); });
    sampled.integrate(20, every(0.01), [&](double t, const auto& x) { between = test::worse(between, error(t, x)); });
    CHECK(between < 2 * at_ends);
    CHECK(sampled.state() == solver.state());
    CHECK(sampled.statistics().evaluations == solver.statistics().evaluations);
  }
}

TEST_CASE("Adams: state and slope are continuous between steps") {
  adams solver(oscillator, 0.0, state<double>(1, 0));
  double before = 0;
  state<double> x_before(1, 0);
  solver.integrate(10, [&](double t, const state<double>& x) {
    if (t == before) return;
    const double d = (t - before) * 1e-6, curved = d * d + 1e-15;  // second derivatives are 1 at most; rounding
    CHECK((solver.interpolate(before + d) - x_before - d * oscillator(before, x_before)).norm() < curved);
    CHECK((solver.interpolate(t - d) - x + d * oscillator(t, x)).norm() < curved);
    before = t, x_before = x;
  });
}

/// An oscillator that may change, and that counts and remembers where it was asked.
struct watched_oscillator {
  double stiffness = 1;
  double least = 1e300, most = -1e300;
  state<double> operator()(double t, const state<double>& x) {
    least = std::min(least, t), most = std::max(most, t);
    return {x[1], -stiffness * x[0]};
  }
};
double distance(const state<double>& x, double q, double p) { return (x - state<double>(q, p)).norm(); }

TEST_CASE("Adams: f is not asked beyond the end, forward and backward") {
  watched_oscillator f;
  adams solver(std::ref(f), 2.0, state<double>(1, 0), {.absolute = 1e-10, .relative = 1e-10});
  for (double end : {2.001, 5.0, 5.0 + 1e-9, 11.3}) {
    solver.integrate(end);
    CHECK(solver.time() == end);
    CHECK(f.most == end);
    CHECK(f.least == 2);
  }
  f.most = -1e300;
  solver.integrate(-3);
  CHECK(solver.time() == -3);
  CHECK(f.least == -3);
  CHECK(f.most == 11.3);
  CHECK(distance(solver.state(), std::cos(5), std::sin(5)) < 1e-7);
}

TEST_CASE("Adams: the end is met exactly, with no tiny last step") {
  adams solver(oscillator, 0.0, state<double>(1, 0));
  for (int i = 1; i <= 200; ++i) {
    std::vector<double> times;
    const double end = 3 + i * 0.0137;
    solver.restart(i / 900.0, state<double>(1, 0));
    solver.integrate(end, [&](double t, const auto&) { times.push_back(t); });
    CHECK(solver.time() == end);
    const std::size_t n = times.size();
    CHECK(times[n - 1] - times[n - 2] > 0.2 * (times[n - 2] - times[n - 3]));  // half of one shortened by 0.5 or more
  }
}

TEST_CASE("Adams: an integration in pieces goes on with its history") {
  const auto cost = [](const std::vector<double>& ends) {
    adams solver(pendulum, 0.0, horizontal<double>(), {.absolute = 1e-10, .relative = 1e-10});
    for (double end : ends) solver.integrate(end);
    CHECK(std::abs(solver.state()[0] - theta10) < 5e-9);
    return solver.statistics().evaluations;
  };
  const auto whole = cost({10});
  std::vector<double> ends;
  for (int i = 1; i <= 20; ++i) ends.push_back(i / 2.0);
  CHECK(cost(ends) < whole + 20 * 6);  // a piece: a step more, one evaluation to compare; again: 40 evaluations
  ends.clear();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> gap(0, 1);
  for (double t = 0; t < 10; ends.push_back(t)) t = std::min(10.0, t + std::pow(gap(random), 6));  // tiny ones too
  CHECK(cost(ends) < whole + 12 * static_cast<long long>(ends.size()));
  CHECK(cost({5, std::nextafter(5.0, 6.0), 10}) < whole + 150);  // the differences are lost in rounding: again
}

TEST_CASE("Adams: nothing old is used after a restart, a turn, or a change of f") {
  watched_oscillator f;
  adams solver(std::ref(f), 0.0, state<double>(1, 0), {.absolute = 1e-10, .relative = 1e-10});
  solver.integrate(1);
  CHECK(solver.order() > 4);
  f.stiffness = 9;
  solver.begin(2);
  CHECK(solver.order() == 1);
  CHECK_THROWS_AS(solver.interpolate(0.999), bad_argument);  // the last step is gone
  solver.integrate(2);
  const double c = std::cos(1), s = std::sin(1), c3 = std::cos(3), s3 = std::sin(3);
  CHECK(distance(solver.state(), c * c3 - s * s3 / 3, -3 * c * s3 - s * c3) < 1e-7);
  solver.restart(7, state<double>(0, 3));
  CHECK(solver.interpolate(7) == state<double>(0, 3));
  solver.integrate(8);
  CHECK(distance(solver.state(), s3, 3 * c3) < 1e-7);
  const int order = solver.order();
  solver.begin(9);
  CHECK(solver.order() == order);
  solver.integrate(7);
  CHECK(distance(solver.state(), 0, 3) < 1e-7);
}

TEST_CASE("Adams: every scalar, and states of dynamic size") {
  adams f(pendulum, 0.0f, horizontal<float>(), {.absolute = 1e-5f, .relative = 1e-5f});
  adams l(pendulum, 0.0l, horizontal<long double>(), {.absolute = 1e-16l, .relative = 1e-16l});
  adams m(pendulum, real50(0), horizontal<real50>(), {.absolute = 1e-22, .relative = 1e-22});
  f.integrate(1), l.integrate(1), m.integrate(1);
  CHECK(static_cast<double>(f.state()[0]) == within(static_cast<double>(theta1), 2e-3));
  CHECK(abs(real50(l.state()[0]) - theta1) < 1e-14);
  CHECK(abs(m.state()[0] - theta1) < 1e-19);
  const auto decay = [](double, const Eigen::VectorXd& x) -> Eigen::VectorXd { return -x; };
  adams d(decay, 0.0, Eigen::VectorXd::Ones(5), {.absolute = 1e-9, .relative = 1e-9});
  d.integrate(1);
  CHECK((d.state().array() - std::exp(-1.0)).abs().maxCoeff() < 1e-8);
}

TEST_CASE("Adams: forces that jump between steps") {
  const auto pushed = [](double force) {
    return [force](double, const state<double>& x) { return state<double>(x[1], force - 9.81 * std::sin(x[0])); };
  };
  const auto alternating = [&](double t, const state<double>& x) {
    return pushed(std::fmod(t, 1) < 0.5 ? 1 : -1)(t, x);
  };
  state<double> exact(1, 0);
  for (int i = 0; i < 40; ++i) {
    adams piece(pushed(i % 2 == 0 ? 1 : -1), i / 2.0, exact, {.absolute = 1e-13, .relative = 1e-13});
    piece.integrate((i + 1) / 2.0);
    exact = piece.state();
  }
  adams solver(alternating, 0.0, state<double>(1, 0), {.absolute = 1e-9, .relative = 1e-9});
  solver.integrate(20);
  CHECK((solver.state() - exact).norm() < 2e-5);  // a history kept over the jumps: 2e-4
}

TEST_CASE("Adams: stiffness and rest") {
  const auto stiff = [](double t, const scalar_state<double>& x) {
    return scalar_state<double>(-1000 * (x[0] - std::cos(t)));
  };
  adams slow(stiff, 0.0, scalar_state<double>(0.0));
  slow.integrate(3);
  CHECK(slow.state()[0] == within(std::cos(3.0) + std::sin(3.0) / 1000, 1e-5));
  CHECK(slow.statistics().steps < 20000);  // steps of about 1/1000
  adams rest([](double, const scalar_state<double>&) { return scalar_state<double>(0.0); }, 0.0,
             scalar_state<double>(0.0));
  rest.integrate(1e6);
  CHECK(rest.state()[0] == 0);
  CHECK(rest.statistics().steps < 60);  // doubled each time
}

TEST_CASE("Adams: failures stop with the last good state") {
  const auto square = [](double, const scalar_state<double>& x) { return scalar_state<double>(x[0] * x[0]); };
  adams blow_up(square, 0.0, scalar_state<double>(1.0));
  CHECK_THROWS_WITH(blow_up.integrate(2), contains_text("stopped at t = ") && contains_text("lost in the rounding"));
  CHECK(blow_up.time() == within_relative(1.0, 1e-4));
  CHECK(std::isfinite(blow_up.state()[0]));
  CHECK(blow_up.interpolate(blow_up.time()) == blow_up.state());
  CHECK_THROWS_AS(blow_up.integrate(2), integration_failure);

  const auto wall = [](double t, const scalar_state<double>&) { return scalar_state<double>(t < 0.5 ? 1.0 : nan); };
  adams stopped(wall, 0.0, scalar_state<double>(0.0));
  CHECK_THROWS_WITH(stopped.integrate(1), contains_text("t = 0.49999") && contains_text("not a finite number"));
  CHECK(stopped.state()[0] == within(stopped.time(), 1e-14));  // exact, but for 100 roundings of 0.5
  CHECK(stopped.statistics().rejected < 100);
  stopped.integrate(0);
  CHECK(stopped.state()[0] == within(0.0, 1e-6));
  adams at_once(wall, 0.7, scalar_state<double>(3.0));
  CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));

  adams short_of_steps(oscillator, 0.0, state<double>(1, 0), {.max_steps = 20});
  CHECK_THROWS_WITH(short_of_steps.integrate(100), contains_text("max_steps = 20"));
  CHECK(short_of_steps.statistics().steps + short_of_steps.statistics().rejected == 20);
  CHECK(distance(short_of_steps.state(), std::cos(short_of_steps.time()), -std::sin(short_of_steps.time())) < 1e-4);
  CHECK_THROWS_AS(adams(oscillator, 0.0, state<double>(1, 0), {.absolute = -1.0}), bad_argument);
}

TEST_CASE("an interval of subnormal length is passed through, or refused after a few tries") {
  const auto f = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
  for (const double end : {1e-320, 5e-324, -1e-320, 1e-300}) {
    CAPTURE(end);
    adams solver(f, 0.0, Eigen::Vector2d(1, 0.5), {.max_steps = 1000});
    try {
      solver.integrate(end);
      CHECK(solver.time() == end);
    } catch (const integration_failure& e) {
      CHECK(e.reason == failure_reason::not_finite);  // not all steps are used up
    }
    CHECK(solver.state() == Eigen::Vector2d(1, 0.5));
  }
}

}  // namespace adams_test
