#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/euler.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include <cmath>

#include "catch.hpp"

// Orders as slopes of error over step or over tolerance, on a nonlinear problem that depends on time:
// x' = -2 t x^2, x(0) = 1, x(t) = 1 / (1 + t^2).

namespace order_test {

using namespace kte;

using scalar = Eigen::Matrix<long double, 1, 1>;
const auto right_hand_side = [](long double t, const scalar& x) { return scalar(-2 * t * x[0] * x[0]); };
long double exact(long double t) { return 1 / (1 + t * t); }

template <template <class, class> class Method>
long double error_with(long double step) {
  Method<decltype(right_hand_side), scalar> solver(right_hand_side, 0.0L, scalar(1.0L), step);
  solver.integrate(2.0L);
  return std::fabs(solver.state()[0] - exact(2));
}
/// At times between the steps.
template <template <class, class> class Method>
long double dense_error_with(long double step) {
  Method<decltype(right_hand_side), scalar> solver(right_hand_side, 0.0L, scalar(1.0L), step);
  long double most = 0;
  solver.integrate(2.0L, every(step / 4),
                   [&](long double t, const scalar& x) { most = test::worse(most, std::fabs(x[0] - exact(t))); });
  return most;
}
template <template <class, class> class Method>
void check(int order, int dense_order) {
  const long double h = 1 / 128.0L;
  CHECK(static_cast<double>(std::log2(error_with<Method>(h) / error_with<Method>(h / 2))) == within(order, 0.1));
  CHECK(static_cast<double>(std::log2(dense_error_with<Method>(h) / dense_error_with<Method>(h / 2))) ==
        within(std::min(order, dense_order + 1), 0.1));  // of a step, a dense output has an order more
}

/// The error of a step is kept at the tolerance: steps are as its root.
template <template <class, class> class Method>
void check_steps(int order_of_error) {
  const auto run = [](long double tolerance) {
    Method<decltype(right_hand_side), scalar> solver(right_hand_side, 0.0L, scalar(1.0L), {tolerance, tolerance});
    solver.integrate(2.0L);
    const auto steps = static_cast<double>(solver.statistics().steps);
    CHECK(std::fabs(solver.state()[0] - exact(2)) < steps * tolerance);  // as solutions come closer to each other
    return steps;
  };
  CHECK(std::log(run(1e-12L) / run(1e-9L)) / std::log(1000) == within(1.0 / order_of_error, 0.02));
}

TEST_CASE("orders of methods with fixed steps, as slopes") {
  SECTION("Euler") { check<euler>(1, 1); }
  SECTION("midpoint") { check<midpoint>(2, 2); }
  SECTION("Kutta, order 4") { check<runge_kutta4>(4, 3); }
  SECTION("Butcher, order 5") { check<runge_kutta5>(5, 4); }
}

TEST_CASE("methods that choose their steps keep tolerances, with as many steps as their order says") {
  check_steps<dormand_prince45>(5);
}

}  // namespace order_test
