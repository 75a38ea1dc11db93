#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "catch.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/vdpol.hpp"
#include "integrators/any_system.hpp"

namespace stiff_one_step_problems_test {

// Accuracy and price for stiff problems of the test sets. The error of a step is kept at the tolerance, so errors in
// the end are as many tolerances as there are steps, and as the problem magnifies: that is not known beforehand. Bounds
// are what was measured, half a digit and a quarter of the evaluations off.

using namespace kte;
using test::any_system, test::system_of, test::system_with_jacobian_of;

struct problem {
  any_system<> f, by_differences;
  Eigen::VectorXd start;
  double t_end;
  double (*digits)(const Eigen::VectorXd& x);  ///< how many are right at the end
};
template <class P>
problem made() {
  return {system_with_jacobian_of<P>(), system_of<P>(), P::start(), static_cast<double>(P::t_end),
          [](const Eigen::VectorXd& x) { return problems::scd(x, P::reference); }};
}
const problem vdpol = made<problems::vdpol<>>(), hires = made<problems::hires<>>();

template <template <class, class> class Method>
auto solved(const problem& p, const any_system<>& f, double tolerance) {
  Method<any_system<>, Eigen::VectorXd> solver(f, 0.0, p.start, {.absolute = tolerance, .relative = tolerance});
  solver.integrate(p.t_end);
  return solver;
}

struct bounds {
  double tolerance, digits;
  long long evaluations;
};
template <template <class, class> class Method>
void check(const problem& p, const bounds& b) {
  const auto solver = solved<Method>(p, p.f, b.tolerance);
  const auto& costs = solver.statistics();
  CAPTURE(b.tolerance, costs.steps, costs.rejected);
  CHECK(p.digits(solver.state()) > b.digits - 0.5);
  CHECK(static_cast<double>(costs.evaluations) < 1.25 * static_cast<double>(b.evaluations));
}
template <template <class, class> class Method>
void check_all(const bounds (&of_vdpol)[2], const bounds (&of_hires)[2]) {
  for (const auto& b : of_vdpol) check<Method>(vdpol, b);
  for (const auto& b : of_hires) check<Method>(hires, b);
}

template <template <class, class> class Method>
void check_differences() {
  const auto exact = solved<Method>(vdpol, vdpol.f, 1e-7);
  const auto differences = solved<Method>(vdpol, vdpol.by_differences, 1e-7);
  CHECK((exact.state() - differences.state()).norm() < 1e-4);  // both are as far from the reference
  CHECK(static_cast<double>(differences.statistics().steps) ==
        within_relative(static_cast<double>(exact.statistics().steps), 0.02));
  CHECK(differences.statistics().evaluations > exact.statistics().evaluations);
}

TEST_CASE("one-step methods for stiff systems: van der Pol's oscillator, mu = 1000, and HIRES") {
  SECTION("rosenbrock23") {
    check_all<rosenbrock23>({{1e-6, 3.59, 5471}, {1e-8, 5.3, 31600}}, {{1e-6, 2.82, 667}, {1e-9, 5.36, 7844}});
  }
  SECTION("RODAS") {
    check_all<rodas>({{1e-6, 5.58, 4747}, {1e-9, 8.4, 27697}}, {{1e-6, 4.08, 592}, {1e-9, 6.99, 3578}});
  }
  SECTION("TR-BDF2") {
    check_all<tr_bdf2>({{1e-6, 3.78, 5358}, {1e-8, 5.1, 23000}}, {{1e-6, 2.53, 570}, {1e-9, 4.48, 4776}});
  }
  SECTION("trapezoidal rule") {
    check_all<trapezoidal>({{1e-6, 3.51, 4360}, {1e-8, 5.1, 16000}}, {{1e-6, 2.39, 658}, {1e-9, 4.41, 3131}});
  }
  SECTION("Kennedy and Carpenter") {
    check_all<kennedy_carpenter34>({{1e-6, 5.76, 6312}, {1e-9, 8.2, 23640}}, {{1e-6, 5.05, 851}, {1e-9, 6.47, 3057}});
  }
}

TEST_CASE("one-step methods for stiff systems: the Jacobian by differences does as well") {
  SECTION("rosenbrock23") { check_differences<rosenbrock23>(); }
  SECTION("RODAS") { check_differences<rodas>(); }
  SECTION("TR-BDF2") { check_differences<tr_bdf2>(); }
  SECTION("trapezoidal rule") { check_differences<trapezoidal>(); }
  SECTION("Kennedy and Carpenter") { check_differences<kennedy_carpenter34>(); }
}

TEST_CASE("Rosenbrock methods: one Jacobian a step, one factorization a try, as many evaluations as stages") {
  const auto two = solved<rosenbrock23>(vdpol, vdpol.f, 1e-5).statistics();
  CHECK(two.rejected > 0);
  CHECK(two.jacobians == two.steps);
  CHECK(two.factorizations == two.steps + two.rejected);
  CHECK(two.evaluations == 2 + two.steps + 2 * (two.steps + two.rejected));  // start, first step size; df/dt; stages
  const auto differences = solved<rosenbrock23>(vdpol, vdpol.by_differences, 1e-5).statistics();
  CHECK(differences.evaluations == 2 + 3 * differences.steps + 2 * (differences.steps + differences.rejected));
  const auto six = solved<rodas>(vdpol, vdpol.f, 1e-5).statistics();
  CHECK(six.evaluations == 1 + 2 * six.steps + 5 * (six.steps + six.rejected));
  CHECK(six.jacobians == six.steps);
}

TEST_CASE("diagonally implicit methods keep the Jacobian over steps, and its factors") {
  for (const auto& costs :
       {solved<tr_bdf2>(hires, hires.f, 1e-7).statistics(), solved<trapezoidal>(hires, hires.f, 1e-7).statistics(),
        solved<kennedy_carpenter34>(hires, hires.f, 1e-9).statistics()}) {
    CHECK(5 * costs.jacobians < costs.steps);
    CHECK(4 * costs.factorizations < 3 * costs.steps);
    CHECK(costs.factorizations >= costs.jacobians);
  }
}

}  // namespace stiff_one_step_problems_test
