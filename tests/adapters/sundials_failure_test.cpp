#include <kte/adapters/sundials.hpp>

#include <limits>
#include <stdexcept>

#include "catch.hpp"

namespace sundials_failure_test {

using namespace kte;
using kte::test::contains_text;

using scalar_state = Eigen::Matrix<double, 1, 1>;
/// x' = 1 is exact by every method; less than 100 steps round by 1e-16 of the state, 10 times that in a history.
constexpr double hundred_roundings = 1e-13;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

/// Calls run(solver) with a new solver of each kind, from 1 at time 0.
template <class F, class Run>
void with_each(const F& f, const Run& run, const tolerances<double>& tol = {}) {
  const scalar_state one(1.0);
  kte::sundials::bdf bdf(f, 0.0, one, tol);
  kte::sundials::adams adams(f, 0.0, one, tol);
  kte::sundials::explicit_runge_kutta dormand_prince(f, 0.0, one, tol);
  kte::sundials::implicit_runge_kutta kvaerno(f, 0.0, one, tol);
  SECTION("bdf") { run(bdf); }
  SECTION("adams") { run(adams); }
  SECTION("explicit Runge-Kutta") { run(dormand_prince); }
  SECTION("implicit Runge-Kutta") { run(kvaerno); }
}

/// A system that claims closed loops.
struct on_loops {
  static constexpr bool has_loops() { return true; }
  scalar_state operator()(double, const scalar_state& x) const { return x; }
};

TEST_CASE("SUNDIALS: systems with closed loops are refused") {
  CHECK_THROWS_WITH(kte::sundials::bdf(on_loops{}, 0.0, scalar_state(1.0)), contains_text("do not keep loops closed"));
}

TEST_CASE("SUNDIALS: a blow-up in finite time stops with the last good state") {
  const auto square = [](double, const scalar_state& x) { return scalar_state(x[0] * x[0]); };
  with_each(square, [](auto& solver) {
    CHECK_THROWS_WITH(solver.integrate(2), contains_text("stopped at t = ") && contains_text("lost in the rounding"));
    CHECK(solver.time() == within_relative(1.0, 1e-4));
    CHECK(solver.state()[0] > 1e6);
    CHECK(std::isfinite(solver.state()[0]));
    CHECK(solver.interpolate(solver.time()) == solver.state());
    CHECK_THROWS_AS(solver.integrate(2), integration_failure);
  });
}

TEST_CASE("SUNDIALS: a right-hand side that is not a number stops the integration before it") {
  const auto f = [](double t, const scalar_state&) { return scalar_state(t < 0.5 ? 1.0 : nan); };
  with_each(f, [](auto& solver) {
    CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0.49999") && contains_text("f is not finite"));
    CHECK(solver.state()[0] == within(1 + solver.time(), hundred_roundings));
    CHECK(solver.statistics().rejected < 100);
    solver.restart(0.7, scalar_state(3.0));
    CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0.69999") && contains_text("f is not finite"));
    CHECK(solver.state()[0] == 3.0);
    solver.restart(0, scalar_state(3.0));
    solver.integrate(0.25);
    CHECK(solver.state()[0] == within(3.25, hundred_roundings));
  });
}

TEST_CASE("SUNDIALS: infinity at the first step") {
  const auto f = [](double t, const scalar_state&) { return scalar_state(t == 0.0 ? 1.0 : inf); };
  with_each(f, [](auto& solver) {
    CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0:") && contains_text("f is not finite"));
    CHECK(solver.state()[0] == 1.0);
  });
}

TEST_CASE("SUNDIALS: its reason is told") {
  const auto f = [](double, const scalar_state& x) { return scalar_state(-1e3 * x[0]); };
  kte::sundials::bdf solver(f, 0.0, scalar_state(1.0));
  CVodeSetMinStep(solver.memory(), 0.1);
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("stopped at t = 0: CV_ERR_FAILURE: ") &&
                                             contains_text("error test failed repeatedly"));
  CHECK(solver.state()[0] == 1.0);
  CVodeSetMinStep(solver.memory(), 0);
  solver.integrate(1);
  CHECK(solver.state()[0] == within(0.0, 1e-5));
}

TEST_CASE("SUNDIALS: too many steps, and on with the rest") {
  const auto f = [](double t, const scalar_state&) { return scalar_state(std::cos(1000 * t)); };
  const tolerances<double> few{.absolute = 1e-8, .relative = 1e-8, .max_steps = 50};
  with_each(
      f,
      [](auto& solver) {
        CHECK_THROWS_WITH(solver.integrate(10), contains_text("max_steps = 50"));
        const auto& s = solver.statistics();
        CHECK(s.steps + s.rejected >= 50);
        CHECK(s.steps + s.rejected < 60);  // several tries at the last step
        const double reached = solver.time();
        CHECK(solver.state()[0] == within(1 + std::sin(1000 * reached) / 1000, 1e-6));
        CHECK_THROWS_AS(solver.integrate(10), integration_failure);
        CHECK(solver.time() > reached);
      },
      few);
}

TEST_CASE("SUNDIALS: what f throws comes out, and the state before it stays") {
  struct own_error {
    double t;
  };
  double wall = 0.3;
  const auto f = [&](double t, const scalar_state&) {
    if (t > wall) throw own_error{t};
    return scalar_state(1.0);
  };
  with_each(f, [&](auto& solver) {
    wall = 0.3;
    try {
      solver.integrate(1);
      FAIL("nothing was thrown");
    } catch (const own_error& e) {
      CHECK(e.t > 0.3);
    }
    CHECK(solver.time() < 0.3);
    CHECK(solver.state()[0] == within(1 + solver.time(), hundred_roundings));
    CHECK(solver.interpolate(solver.time()) == solver.state());
    wall = 2;
    solver.integrate(1);
    CHECK(solver.state()[0] == within(2.0, hundred_roundings));
    CHECK_THROWS_AS(solver.integrate(2, every(0.5),
                                     [](double t, const auto&) {
                                       if (t > 1) throw own_error{t};
                                     }),
                    own_error);
    solver.integrate(2);
    CHECK(solver.state()[0] == within(3.0, hundred_roundings));
  });
}

TEST_CASE("SUNDIALS: what f throws where it is called to interpolate") {
  bool broken = false;
  const auto f = [&](double, const scalar_state& x) {
    if (broken) throw std::domain_error("broken");
    return scalar_state(-x[0]);
  };
  kte::sundials::explicit_runge_kutta solver(f, 0.0, scalar_state(1.0));
  double last = 0, before = 0;
  solver.integrate(1, [&](double t, const auto&) { before = last, last = t; });
  broken = true;
  CHECK_THROWS_AS(solver.interpolate((before + last) / 2), std::domain_error);
  broken = false;
  // a few steps, each within 1e-6 (1 + x)
  CHECK(solver.interpolate((before + last) / 2)[0] == within(std::exp(-(before + last) / 2), 1e-5));
}

struct bad_jacobian {
  bool throws;
  scalar_state operator()(double, const scalar_state& x) const { return -x; }
  void jacobian(double, const scalar_state&, scalar_state& j) const {
    if (throws) throw std::domain_error("no Jacobian");
    j[0] = nan;
  }
};

TEST_CASE("SUNDIALS: Jacobians that throw or are not numbers") {
  for (bool throws : {true, false}) {
    kte::sundials::bdf bdf(bad_jacobian{throws}, 0.0, scalar_state(1.0));
    kte::sundials::implicit_runge_kutta kvaerno(bad_jacobian{throws}, 0.0, scalar_state(1.0));
    const auto message = contains_text(throws ? "no Jacobian" : "f is not finite");
    CHECK_THROWS_WITH(bdf.integrate(1), message);
    CHECK_THROWS_WITH(kvaerno.integrate(1), message);
    CHECK(bdf.time() == 0);
    CHECK(bdf.state()[0] == 1);
  }
}

TEST_CASE("SUNDIALS: bad settings are rejected with their value") {
  const auto f = [](double, const scalar_state& x) { return scalar_state(-x[0]); };
  const scalar_state one(1.0);
  for (double bad : {-1e-6, nan, inf}) {
    CHECK_THROWS_AS(kte::sundials::bdf(f, 0.0, one, {.absolute = bad}), bad_argument);
    CHECK_THROWS_AS(kte::sundials::explicit_runge_kutta(f, 0.0, one, {.relative = bad}), bad_argument);
  }
  CHECK_THROWS_WITH(kte::sundials::adams(f, 0.0, one, {.max_steps = 0}), contains_text("max_steps"));
  CHECK_THROWS_WITH(kte::sundials::bdf(f, nan, one), contains_text("start time must be finite, got nan"));
  CHECK_THROWS_AS(kte::sundials::explicit_runge_kutta(f, 0.0, one, {}, ARKODE_ERK_NONE), bad_argument);
  const auto g = [](double, const Eigen::VectorXd&) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(3); };
  kte::sundials::bdf wrong(g, 0.0, Eigen::VectorXd::Ones(5));
  CHECK_THROWS_WITH(wrong.integrate(1), contains_text("gave 3 numbers for a state of 5"));
  CHECK_THROWS_WITH(wrong.integrate(nan), contains_text("end time must be finite, got nan"));
}

}  // namespace sundials_failure_test
