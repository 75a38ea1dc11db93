#include <kte/integrators/bdf.hpp>

#include <limits>

#include "catch.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/orego.hpp"
#include "data/problems/rober.hpp"
#include "data/problems/vdpol.hpp"

namespace bdf_problems_test {

using namespace kte;
using kte::test::contains_text;

using scalar_state = Eigen::Matrix<double, 1, 1>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

/// A problem without its Jacobian.
template <class Problem>
struct by_differences {
  auto operator()(double t, const typename Problem::state& x) const { return Problem()(t, x); }
};

/// Solves a problem with a relative tolerance, and an absolute one for numbers below `small`.
template <class Problem, class F = Problem>
auto solved(double tolerance, double small, const bdf_settings& settings = {}) {
  bdf solver(F(), 0.0, Problem::start(), {.absolute = tolerance * small, .relative = tolerance}, settings);
  solver.integrate(static_cast<double>(Problem::t_end));
  const auto& s = solver.statistics();
  UNSCOPED_INFO(Problem::name << ", " << tolerance << ": scd " << problems::scd(solver.state(), Problem::reference)
                              << ", steps " << s.steps << " + " << s.rejected << ", evaluations " << s.evaluations
                              << ", Jacobians " << s.jacobians << ", factorizations " << s.factorizations);
  return solver;
}
/// Errors at the end are about the tolerance, all the way down.
template <class Problem>
void check(double small, const bdf_settings& settings = {}) {
  for (const int digits : {4, 6, 9, 11}) {
    const auto solver = solved<Problem>(std::pow(10.0, -digits), small, settings);
    const auto& s = solver.statistics();
    CHECK(problems::scd(solver.state(), Problem::reference) > digits - (digits == 9 ? 1 : 1.3));
    CHECK(2 * s.evaluations < 5 * s.steps);
    CHECK(10 * s.jacobians < s.steps);
    CHECK(3 * s.factorizations < s.steps);
  }
}

TEST_CASE("BDF: stiff problems of the test sets, to the tolerance") {
  for (const bdf_formula formula : {bdf_formula::numerical_differentiation, bdf_formula::backward_differentiation}) {
    check<problems::vdpol<>>(1e-3, {.formula = formula});
    check<problems::hires<>>(1e-4, {.formula = formula});
    check<problems::orego<>>(1e-3, {.formula = formula});
    check<problems::rober<>>(1e-10, {.formula = formula});
  }
}

TEST_CASE("BDF: a Jacobian by differences does as well") {
  using problem = problems::hires<>;
  const auto given = solved<problem>(1e-9, 1e-4);
  const auto found = solved<problem, by_differences<problem>>(1e-9, 1e-4);
  CHECK(problems::scd(found.state(), problem::reference) > 8);
  CHECK(static_cast<double>(found.statistics().steps) ==
        within_relative(static_cast<double>(given.statistics().steps), 0.05));
}

TEST_CASE("BDF: lower orders need more steps") {
  using problem = problems::vdpol<>;
  long long last = solved<problem>(1e-6, 1e-3, {.max_order = 5}).statistics().steps;
  for (int order = 4; order > 1; --order) {
    const auto solver = solved<problem>(1e-6, 1e-3, {.max_order = order});
    CHECK(problems::scd(solver.state(), problem::reference) > 4.5);
    CHECK(solver.statistics().steps > last);
    last = solver.statistics().steps;
  }
}

// Modes of 1, 16, ... 1296 rad/s without damping, as in a beam. Only the slowest moves. Without a bound by the
// spectrum orders 3 to 5 made the others grow: 14,271 and 35,312 evaluations.
TEST_CASE("BDF: undamped modes that do not move cost nothing") {
  using square = Eigen::Matrix<double, 6, 6>;
  using vector = Eigen::Matrix<double, 6, 1>;
  using state = Eigen::Matrix<double, 12, 1>;
  const vector u = vector::LinSpaced(1, 6), rates = u.array().pow(4);
  const square modes = square::Identity() - 2 / u.squaredNorm() * u * u.transpose();
  const square stiffness = modes * rates.array().square().matrix().asDiagonal() * modes.transpose();
  const auto f = [&](double, const state& x) {
    state r;
    r << x.tail<6>(), -stiffness * x.head<6>();
    return r;
  };
  state x0;
  x0 << modes.col(0), vector::Zero();
  const auto solve = [&](double tolerance, int most, double moves = 0) {
    state x = x0;
    x.head<6>() += moves * modes.col(5);
    bdf solver(f, 0.0, x, {.absolute = tolerance, .relative = tolerance}, {.max_order = most});
    solver.integrate(moves == 0 ? 10 : 0.1);
    return solver;
  };
  for (const double tolerance : {1e-6, 1e-8}) {
    const auto all = solve(tolerance, 5), second = solve(tolerance, 2);
    CHECK(10 * all.statistics().evaluations < 11 * second.statistics().evaluations);
    CHECK((all.state().head<6>() - std::cos(10.0) * modes.col(0)).norm() < 500 * tolerance);
  }
  // where the fastest moves, too, it is followed, at high order
  const auto all = solve(1e-6, 5, 1e-2), second = solve(1e-6, 2, 1e-2);
  CHECK(all.order() == 5);
  CHECK(2 * all.statistics().evaluations < second.statistics().evaluations);
}

TEST_CASE("BDF: a blow-up in finite time stops with the last good state") {
  const auto square = [](double, const scalar_state& x) { return scalar_state(x[0] * x[0]); };
  bdf solver(square, 0.0, scalar_state(1.0));
  CHECK_THROWS_WITH(solver.integrate(2),
                    contains_text("stopped at t = 0.99999") && contains_text("lost in the rounding"));
  CHECK(solver.time() == within_relative(1.0, 1e-4));
  CHECK(solver.state()[0] > 1e6);
  CHECK(std::isfinite(solver.state()[0]));
  CHECK(solver.interpolate(solver.time()) == solver.state());
  CHECK_THROWS_AS(solver.integrate(2), integration_failure);
}

TEST_CASE("BDF: a right-hand side that is not a number stops the integration before it") {
  for (const double bad : {nan, inf, -inf}) {
    const auto f = [&](double t, const scalar_state&) { return scalar_state(t < 0.5 ? 1.0 : bad); };
    bdf solver(f, 0.0, scalar_state(0.0));
    CHECK_THROWS_WITH(solver.integrate(1),
                      contains_text("t = 0.49999") && contains_text("not a finite number, however"));
    CHECK(solver.state()[0] == within(solver.time(), 1e-14));  // exact, but for 100 roundings of 0.5
    CHECK(solver.statistics().rejected < 200);
    bdf at_once(f, 0.7, scalar_state(3.0));
    CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));
    CHECK(at_once.state()[0] == 3.0);
  }
  struct root {
    scalar_state operator()(double, const scalar_state& x) const { return scalar_state(-std::sqrt(x[0])); }
    void jacobian(double, const scalar_state&, scalar_state& J) const { J[0] = nan; }
  };
  bdf solver(root(), 0.0, scalar_state(1.0));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0:") && contains_text("Jacobian"));
}

TEST_CASE("BDF: where the matrix is singular for a step, another step is taken") {
  struct clock {
    double rate;  // given as the Jacobian: singular for c = 1 / rate
    scalar_state operator()(double, const scalar_state&) const { return scalar_state(1.0); }
    void jacobian(double, const scalar_state&, scalar_state& J) const { J[0] = rate; }
  };
  const bdf_settings plain{.formula = bdf_formula::backward_differentiation};  // c = h at order 1
  bdf right(clock{0}, 0.0, scalar_state(0.0), {}, plain);
  right.begin(1);
  right.step(1);
  const double h = right.time();
  double rate = 1 / h;
  if (h * rate != 1) rate = std::nextafter(rate, h * rate < 1 ? inf : 0.0);
  REQUIRE(h * rate == 1);
  REQUIRE(right.statistics().rejected == 0);
  bdf singular(clock{rate}, 0.0, scalar_state(0.0), {}, plain);
  singular.begin(1);
  singular.step(1);
  CHECK(singular.time() == h / 4);
  CHECK(singular.statistics().rejected == 1);
  singular.integrate(1);
  CHECK(singular.state()[0] == within(1.0, 1e-6));  // the Jacobian is wrong, so Newton's iterations leave something
}

TEST_CASE("BDF: too many steps, and bad settings") {
  const auto f = [](double t, const scalar_state& x) { return scalar_state(-1e6 * (x[0] - std::cos(t))); };
  const scalar_state x(1.0);
  bdf solver(f, 0.0, x, {.absolute = 1e-9, .relative = 1e-9, .max_steps = 100});
  CHECK_THROWS_WITH(solver.integrate(10), contains_text("max_steps = 100 steps"));
  CHECK(solver.statistics().steps + solver.statistics().rejected == 100);
  CHECK(solver.state()[0] == within(std::cos(solver.time()), 1e-5));
  for (int order : {0, 6, -1})
    CHECK_THROWS_WITH(bdf(f, 0.0, x, {}, {.max_order = order}),
                      contains_text("max_order must be 1 to 5, got " + std::to_string(order)));
  CHECK_THROWS_AS(bdf(f, 0.0, x, {.relative = nan}), bad_argument);
  CHECK_THROWS_AS(bdf(f, nan, x), bad_argument);
  CHECK_THROWS_AS(solver.integrate(inf), bad_argument);
}

}  // namespace bdf_problems_test
