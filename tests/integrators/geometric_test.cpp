#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>
#include <kte/integrators/stormer_verlet.hpp>

#include <cmath>

#include "catch.hpp"

// Methods that keep the energy of conservative systems, on a pendulum q'' = -sin q, and on q'' = -q + sin t - q_dot,
// whose solution from (0, 0) is known.

namespace geometric_test {

using namespace kte;
using kte::test::contains_text;

using pair = Eigen::Matrix<long double, 2, 1>;
const auto damped = [](long double t, const pair& x) { return pair(x[1], -x[0] + std::sin(t) - x[1]); };
/// From (0, 0): e^(-t/2) (cos wt + sin(wt) / (2 w)) - cos t, w = sqrt(3)/2.
long double exact(long double t) {
  const long double w = std::sqrt(3.0L) / 2;
  return std::exp(-t / 2) * (std::cos(w * t) + std::sin(w * t) / (2 * w)) - std::cos(t);
}

template <template <class, class> class Method>
std::pair<long double, long double> errors_with(long double step) {
  Method<decltype(damped), pair> solver(damped, 0.0L, pair(0, 0), step);
  long double between = 0;
  solver.integrate(2.0L, every(step / 4),
                   [&](long double t, const pair& x) { between = test::worse(between, std::fabs(x[0] - exact(t))); });
  return {std::fabs(solver.state()[0] - exact(2)), between};
}
template <template <class, class> class Method>
void check_order(int order) {
  const auto coarse = errors_with<Method>(1 / 64.0L), fine = errors_with<Method>(1 / 128.0L);
  CHECK(std::log2(double(coarse.first / fine.first)) == within(order, 0.1));
  CHECK(std::log2(double(coarse.second / fine.second)) == within(order, 0.1));
}

double energy(const Eigen::Vector2d& x) { return x[1] * x[1] / 2 - std::cos(x[0]); }
const auto gravity = [](double, const auto& q) { return (-q.array().sin()).matrix(); };
const auto pendulum = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -std::sin(x[0])); };

/// The largest change of energy in each half of a run of 2e5 steps of 0.05, some 1e3 swings.
template <class Solver>
std::pair<double, double> wandering(Solver solver) {
  const double start = energy(solver.state());
  double halves[]{0, 0};
  solver.integrate(10000, [&](double t, const Eigen::Vector2d& x) {
    double& most = halves[t > 5000];
    most = test::worse(most, std::abs(energy(x) - start));
  });
  return {halves[0], halves[1]};
}

TEST_CASE("geometric methods have their orders, also between steps") {
  SECTION("semi-implicit Euler") { check_order<semi_implicit_euler>(1); }
  SECTION("Stormer and Verlet") { check_order<stormer_verlet>(2); }
  SECTION("implicit midpoint") { check_order<implicit_midpoint>(2); }
}

TEST_CASE("geometric methods let energy oscillate and not drift, unlike Kutta's", "[long]") {
  const Eigen::Vector2d start(2, 0);
  const auto system = second_order(gravity);
  const double h = 0.05;
  const auto check = [](const std::pair<double, double>& e, double bound) {
    CHECK(e.first < bound);
    CHECK(e.second <= e.first * (1 + 1e-3));  // more swings meet no larger error, but for where steps fall
  };
  check(wandering(semi_implicit_euler(system, 0.0, start, h)), h);
  check(wandering(stormer_verlet(system, 0.0, start, h)), h * h);
  check(wandering(stormer_verlet(pendulum, 0.0, start, h)), h * h);
  check(wandering(implicit_midpoint(pendulum, 0.0, start, h)), h * h);
  const auto kutta = wandering(runge_kutta4(pendulum, 0.0, start, h));
  CHECK(kutta.second > 1.9 * kutta.first);
}

TEST_CASE("a system without velocities costs Stormer and Verlet one evaluation a step") {
  stormer_verlet once(second_order(gravity), 0.0, Eigen::Vector2d(1, 0), 0.125);
  stormer_verlet solved(pendulum, 0.0, Eigen::Vector2d(1, 0), 0.125);
  once.integrate(8), solved.integrate(8);
  CHECK(once.statistics().evaluations == 64 + 1);
  CHECK(solved.statistics().evaluations == 2 * 64 + 1);
  CHECK(once.state() == solved.state());
}

TEST_CASE("symmetric methods go back to where they came from") {
  const auto there_and_back = [](auto solver) {
    solver.integrate(20);
    solver.integrate(0);
    return (solver.state() - Eigen::Vector2d(2, 0)).norm();
  };
  // 800 steps of some 4 roundings of numbers up to 2, that grow with time as the phase
  CHECK(there_and_back(stormer_verlet(pendulum, 0.0, Eigen::Vector2d(2, 0), 0.05)) < 800 * 4 * 2.2e-16);
  CHECK(there_and_back(implicit_midpoint(pendulum, 0.0, Eigen::Vector2d(2, 0), 0.05)) < 800 * 4 * 2.2e-16);
}

TEST_CASE("the midpoint rule keeps quadratic invariants of vectors") {
  // A free body: I1 w1' = (I2 - I3) w2 w3, ...: energy and the norm of the momentum.
  const auto body = [](double, const Eigen::Vector3d& w) {
    return Eigen::Vector3d(-w[1] * w[2], w[2] * w[0], -w[0] * w[1] / 3);
  };
  implicit_midpoint solver(body, 0.0, Eigen::Vector3d(0.01, 10, 0.01), 0.01);
  const Eigen::Vector3d inertia(1, 2, 3);
  const auto energy_of = [&](const Eigen::Vector3d& w) { return w.cwiseAbs2().dot(inertia) / 2; };
  const auto momentum_of = [&](const Eigen::Vector3d& w) { return w.cwiseProduct(inertia).norm(); };
  const double e = energy_of(solver.state()), l = momentum_of(solver.state());
  solver.integrate(100);
  CHECK(energy_of(solver.state()) == within_relative(e, 1e-13));  // a random walk of 1e4 roundings
  CHECK(momentum_of(solver.state()) == within_relative(l, 1e-13));
}

TEST_CASE("geometric methods say what is wrong") {
  const auto stiff = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -1e6 * x[0] - 1e4 * x[1]); };
  implicit_midpoint solver(stiff, 0.0, Eigen::Vector2d(1, 0), 0.01);
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("stopped at t = 0: the iteration of a step of 0.01 does not "
                                                       "converge: it is too long"));
  const auto odd = [](double, const Eigen::Vector3d& x) { return x; };
  semi_implicit_euler lame(odd, 0.0, Eigen::Vector3d(1, 2, 3), 0.1);
  CHECK_THROWS_WITH(lame.integrate(1), contains_text("of 3 numbers they cannot be halves"));
  const auto lost = [](double, const Eigen::Vector2d&) { return Eigen::Vector2d(0, std::nan("")); };
  stormer_verlet nowhere(lost, 0.0, Eigen::Vector2d(1, 0), 0.1);
  CHECK_THROWS_AS(nowhere.integrate(1), integration_failure);
  CHECK(nowhere.state() == Eigen::Vector2d(1, 0));
}

TEST_CASE("an iteration whose right-hand side is NaN does not reject the step") {
  const auto ends = [](double t, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x[1], t < 0.5 ? -x[0] : std::nan(""));
  };
  implicit_midpoint solver(ends, 0.0, Eigen::Vector2d(1, 0), 0.01);
  try {
    solver.integrate(1);
    CHECK(false);
  } catch (const integration_failure& e) {
    CHECK_THAT(e.what(), contains_text("stopped at t = 0.5: the next state is not a finite number"));
    CHECK(e.reason == failure_reason::not_finite);
    CHECK(e.component == 1);
  }
  const auto squares = [](double, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x[0] * x[0], 0);
  };  // (2 + k / 2)^2 = k has no solution
  implicit_midpoint diverges(squares, 0.0, Eigen::Vector2d(2, 0), 1.0);
  CHECK_THROWS_WITH(diverges.integrate(1), contains_text("a step of 1 does not converge: it is too long"));
}

}  // namespace geometric_test
