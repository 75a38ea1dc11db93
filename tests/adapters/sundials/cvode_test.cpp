#include <kte/adapters/sundials/cvode.hpp>

#include "catch.hpp"

namespace cvode_test {

using namespace kte;

constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
const Eigen::Vector2d start(1, 0);
const tolerances<double> tight{.absolute = 1e-12, .relative = 1e-12};

template <class Solver>
int highest_order(Solver& solver) {
  int most = 0;
  solver.integrate(10, [&](double, const auto&) {
    int order = 0;
    CVodeGetLastOrder(solver.memory(), &order);
    most = std::max(most, order);
  });
  return most;
}

TEST_CASE("CVODE: orders up to 5 and up to 12, or what is asked of its memory") {
  kte::sundials::bdf bdf(oscillator, 0.0, start, tight), bdf_of_2(oscillator, 0.0, start, tight);
  kte::sundials::adams adams(oscillator, 0.0, start, tight);
  CHECK(highest_order(bdf) == 5);
  const int high = highest_order(adams);
  CHECK(high > 5);
  CHECK(high <= 12);
  CVodeSetMaxOrd(bdf_of_2.memory(), 2);
  CHECK(highest_order(bdf_of_2) == 2);
  CHECK(bdf_of_2.statistics().steps > 10 * bdf.statistics().steps);
}

TEST_CASE("CVODE: its counts are the statistics, of all starts together") {
  const auto jumping = [](double t, const Eigen::Vector2d& x) {
    return Eigen::Vector2d(x[1], std::fmod(t, 1) < 0.5 ? -x[0] : -9 * x[0]);
  };
  const auto check = [](auto& solver, bool newton) {
    long rejected = 0, jacobians = 0, setups = 0;
    for (int start_again = 0; start_again < 3; ++start_again) {
      solver.restart(0, start);
      solver.integrate(5);
      long by_error = 0, by_newton = 0, j = 0, s = 0;
      CVodeGetNumErrTestFails(solver.memory(), &by_error);
      CVodeGetNumStepSolveFails(solver.memory(), &by_newton);
      if (newton) CVodeGetNumJacEvals(solver.memory(), &j), CVodeGetNumLinSolvSetups(solver.memory(), &s);
      rejected += by_error + by_newton, jacobians += j, setups += s;
      CHECK(solver.statistics().rejected == rejected);
      CHECK(solver.statistics().jacobians == jacobians);
      CHECK(solver.statistics().factorizations == setups);
    }
    CHECK(rejected > 10);
    CHECK((setups > 10) == newton);
  };
  kte::sundials::bdf bdf(jumping, 0.0, start);
  kte::sundials::adams adams(jumping, 0.0, start);
  check(bdf, true);
  check(adams, false);  // functional iteration: no Jacobian
}

}  // namespace cvode_test
