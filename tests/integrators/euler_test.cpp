#include <kte/integrators/euler.hpp>

#include <vector>

#include "catch.hpp"

namespace euler_test {

using namespace kte;

constexpr auto pendulum = [](double, const Eigen::Vector2d& x) {  // 0.5 m, 9.81 m/s^2
  return Eigen::Vector2d(x[1], -19.62 * std::sin(x[0]));
};
constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
constexpr auto clock = [](double, const Eigen::Vector2d&) { return Eigen::Vector2d(1, 2); };

template <class F>
double error_at_1(const F& f, double x0, double exact, double step) {
  euler solver(f, 0.0, Eigen::Vector2d(x0, 0), step);
  solver.integrate(1);
  return std::abs(solver.state()[0] - exact);
}

TEST_CASE("Euler: the global error is of order 1") {
  const double horizontal = std::acos(0.0), theta1 = -1.31124604230103985440444713;
  for (double h : {1.0 / 8192, 1.0 / 16384}) {
    CHECK(std::log2(error_at_1(pendulum, horizontal, theta1, h) / error_at_1(pendulum, horizontal, theta1, h / 2)) ==
          within(1.0, 0.1));
    const double c = std::cos(1.0);
    CHECK(std::log2(error_at_1(oscillator, 1, c, h) / error_at_1(oscillator, 1, c, h / 2)) == within(1.0, 0.1));
  }
}

TEST_CASE("Euler: steps are counted, the last one is shorter") {
  std::vector<double> times;
  euler solver(clock, 1.0, Eigen::Vector2d(0, 0), 0.1);
  solver.integrate(1.35, [&](double t, const Eigen::Vector2d&) { times.push_back(t); });
  CHECK(times == std::vector<double>{1, 1 + 0.1, 1 + 2 * 0.1, 1 + 3 * 0.1, 1.35});
  CHECK(solver.statistics().steps == 4);
  CHECK(solver.statistics().evaluations == 4);
  CHECK(solver.state()[0] == within(0.35, 4e-16));  // times above 1 round by 1.1e-16, four sums by 3e-17
}

TEST_CASE("Euler: no step of a rounding error at the end") {
  euler solver(clock, 0.0, Eigen::Vector2d(0, 0), 0.1);
  solver.integrate(std::nextafter(3 * 0.1, 1.0));
  CHECK(solver.statistics().steps == 3);
  CHECK(solver.time() == std::nextafter(3 * 0.1, 1.0));
  solver.integrate(1000);
  CHECK(solver.statistics().steps == 3 + 9997);
  CHECK(solver.time() == 1000);
  CHECK(solver.state()[1] == within(2000, 1e-9));  // 1e4 sums round by up to half an ulp, 1.1e-13
}

TEST_CASE("Euler: between steps the state is linear") {
  std::vector<double> times, values;
  euler solver(oscillator, 0.0, Eigen::Vector2d(1, 0), 0.5);
  solver.integrate(1, every(0.25), [&](double t, const auto& x) { times.push_back(t), values.push_back(x[1]); });
  CHECK(times == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
  CHECK(values == std::vector<double>{0, -0.25, -0.5, -0.75, -1});
}

TEST_CASE("Euler: backward in time") {
  euler solver(clock, 2.0, Eigen::Vector2d(0, 0), 0.3);
  solver.integrate(1);
  CHECK(solver.time() == 1);
  CHECK(solver.state()[1] == within(-2, 1e-15));  // four roundings, and those of times
  CHECK(solver.statistics().steps == 4);
}

TEST_CASE("Euler: fails where the state is no longer a number") {
  const auto square = [](double, const Eigen::Matrix<double, 1, 1>& x) {
    return Eigen::Matrix<double, 1, 1>(x[0] * x[0]);
  };
  euler solver(square, 0.0, Eigen::Matrix<double, 1, 1>(1.0), 0.01);
  CHECK_THROWS_WITH(solver.integrate(2),
                    kte::test::contains_text("stopped at t = 1.") && kte::test::contains_text("not a finite number"));
  CHECK(solver.time() > 1);
  CHECK(solver.time() < 2);
  CHECK(std::isfinite(solver.state()[0]));
}

TEST_CASE("Euler: bad steps are rejected with their value") {
  const Eigen::Vector2d x(0, 0);
  CHECK_THROWS_WITH(euler(clock, 0.0, x, 0.0), kte::test::contains_text("step must be finite and positive, got 0"));
  CHECK_THROWS_WITH(euler(clock, 0.0, x, -0.5), kte::test::contains_text("got -0.5"));
  CHECK_THROWS_AS(euler(clock, 0.0, x, std::nan("")), bad_argument);
  euler tiny(clock, 1.0, x, 1e-17);
  CHECK_THROWS_WITH(tiny.integrate(2), kte::test::contains_text("is too small to go from 1 to 2"));
}

}  // namespace euler_test
