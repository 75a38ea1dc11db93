#include <kte/integrators/bdf.hpp>

#include <limits>

#include "catch.hpp"
#include "data/problems/hires.hpp"
#include "data/problems/orego.hpp"
#include "data/problems/rober.hpp"
#include "data/problems/vdpol.hpp"
#include "integrators/any_system.hpp"

namespace bdf_problems_test {

using namespace kte;
using kte::test::any_system, kte::test::contains_text, kte::test::numbers, kte::test::system_of,
    kte::test::system_with_jacobian_of;
using state = Eigen::VectorXd;
using solver_type = bdf<any_system<>, state>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

/// A stiff problem; its numbers are of interest down to the size `small`.
struct problem {
  const char* name;
  double small, t_end;
  state start;
  any_system<> f, without_jacobian;
  double (*digits)(const state&);  ///< how many are right at the end
};
template <class P>
problem made(double small) {
  const auto digits = [](const state& x) { return problems::scd(x, P::reference); };
  return {P::name,        small, static_cast<double>(P::t_end), P::start(), system_with_jacobian_of<P>(),
          system_of<P>(), digits};
}
const problem vdpol = made<problems::vdpol<>>(1e-3), hires = made<problems::hires<>>(1e-4),
              orego = made<problems::orego<>>(1e-3), rober = made<problems::rober<>>(1e-10);

/// Solves a problem with a relative tolerance, and an absolute one for small numbers.
auto solved(const problem& p, const any_system<>& f, double tolerance, const bdf_settings& settings = {}) {
  solver_type solver(f, 0.0, p.start, {.absolute = tolerance * p.small, .relative = tolerance}, settings);
  solver.integrate(p.t_end);
  const auto& s = solver.statistics();
  UNSCOPED_INFO(p.name << ", " << tolerance << ": scd " << p.digits(solver.state()) << ", steps " << s.steps << " + "
                       << s.rejected << ", evaluations " << s.evaluations << ", Jacobians " << s.jacobians
                       << ", factorizations " << s.factorizations);
  return solver;
}

TEST_CASE("BDF: stiff problems of the test sets, to the tolerance", "[long]") {
  // Errors at the end are about the tolerance, all the way down.
  for (const bdf_formula formula : {bdf_formula::numerical_differentiation, bdf_formula::backward_differentiation})
    for (const problem* p : {&vdpol, &hires, &orego, &rober})
      for (const int digits : {4, 6, 9, 11}) {
        const auto solver = solved(*p, p->f, std::pow(10.0, -digits), {.formula = formula});
        const auto& s = solver.statistics();
        CHECK(p->digits(solver.state()) > digits - (digits == 9 ? 1 : 1.3));
        CHECK(2 * s.evaluations < 5 * s.steps);
        CHECK(10 * s.jacobians < s.steps);
        CHECK(3 * s.factorizations < s.steps);
      }
}

TEST_CASE("BDF: a Jacobian by differences does as well") {
  const auto given = solved(hires, hires.f, 1e-9), found = solved(hires, hires.without_jacobian, 1e-9);
  CHECK(hires.digits(found.state()) > 8);
  CHECK(static_cast<double>(found.statistics().steps) ==
        within_relative(static_cast<double>(given.statistics().steps), 0.05));
}

TEST_CASE("BDF: lower orders need more steps") {
  long long last = solved(vdpol, vdpol.f, 1e-6, {.max_order = 5}).statistics().steps;
  for (int order = 4; order > 1; --order) {
    const auto solver = solved(vdpol, vdpol.f, 1e-6, {.max_order = order});
    CHECK(vdpol.digits(solver.state()) > 4.5);
    CHECK(solver.statistics().steps > last);
    last = solver.statistics().steps;
  }
}

// Modes of 1, 16, ... 1296 rad/s without damping, as in a beam. Only the slowest moves. Without a bound by the
// spectrum orders 3 to 5 made the others grow: 14,271 and 35,312 evaluations.
TEST_CASE("BDF: undamped modes that do not move cost nothing") {
  const state u = state::LinSpaced(6, 1, 6), rates = u.array().pow(4);
  const Eigen::MatrixXd modes = Eigen::MatrixXd::Identity(6, 6) - 2 / u.squaredNorm() * u * u.transpose();
  const Eigen::MatrixXd stiffness = modes * rates.array().square().matrix().asDiagonal() * modes.transpose();
  const auto f = [&](double, const state& x) {
    state r(12);
    r << x.tail(6), -stiffness * x.head(6);
    return r;
  };
  const auto solve = [&](double tolerance, int most, double moves = 0) {
    state x(12);
    x << modes.col(0) + moves * modes.col(5), state::Zero(6);
    solver_type solver({f}, 0.0, x, {.absolute = tolerance, .relative = tolerance}, {.max_order = most});
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
  solver_type solver({[](double, const state& x) { return numbers(x[0] * x[0]); }}, 0.0, numbers(1));
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
    const any_system<> f([bad](double t, const state&) { return numbers(t < 0.5 ? 1.0 : bad); });
    solver_type solver(f, 0.0, numbers(0));
    CHECK_THROWS_WITH(solver.integrate(1),
                      contains_text("t = 0.49999") && contains_text("not a finite number, however"));
    CHECK(solver.state()[0] == within(solver.time(), 1e-14));  // exact, but for 100 roundings of 0.5
    CHECK(solver.statistics().rejected < 200);
    solver_type at_once(f, 0.7, numbers(3));
    CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));
    CHECK(at_once.state()[0] == 3.0);
  }
  const any_system<> root([](double, const state& x) { return numbers(-std::sqrt(x[0])); },
                          [](double, const state&, Eigen::MatrixXd& J) { J(0, 0) = nan; });
  solver_type solver(root, 0.0, numbers(1));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("t = 0:") && contains_text("Jacobian"));
}

TEST_CASE("BDF: where the matrix is singular for a step, another step is taken") {
  const auto clock = [](double rate) {  // given as the Jacobian: singular for c = 1 / rate
    return any_system<>([](double, const state&) { return numbers(1); },
                        [rate](double, const state&, Eigen::MatrixXd& J) { J(0, 0) = rate; });
  };
  const bdf_settings plain{.formula = bdf_formula::backward_differentiation};  // c = h at order 1
  solver_type right(clock(0), 0.0, numbers(0), {}, plain);
  right.begin(1);
  right.step(1);
  const double h = right.time();
  double rate = 1 / h;
  if (h * rate != 1) rate = std::nextafter(rate, h * rate < 1 ? inf : 0.0);
  REQUIRE(h * rate == 1);
  REQUIRE(right.statistics().rejected == 0);
  solver_type singular(clock(rate), 0.0, numbers(0), {}, plain);
  singular.begin(1);
  singular.step(1);
  CHECK(singular.time() == h / 4);
  CHECK(singular.statistics().rejected == 1);
  singular.integrate(1);
  CHECK(singular.state()[0] == within(1.0, 1e-6));  // the Jacobian is wrong, so Newton's iterations leave something
}

TEST_CASE("BDF: too many steps, and bad settings") {
  const any_system<> f([](double t, const state& x) { return numbers(-1e6 * (x[0] - std::cos(t))); });
  const state x = numbers(1);
  solver_type solver(f, 0.0, x, {.absolute = 1e-9, .relative = 1e-9, .max_steps = 100});
  CHECK_THROWS_WITH(solver.integrate(10), contains_text("max_steps = 100 steps"));
  CHECK(solver.statistics().steps + solver.statistics().rejected == 100);
  CHECK(solver.state()[0] == within(std::cos(solver.time()), 1e-5));
  for (int order : {0, 6, -1})
    CHECK_THROWS_WITH(solver_type(f, 0.0, x, {}, {.max_order = order}),
                      contains_text("max_order must be 1 to 5, got " + std::to_string(order)));
  CHECK_THROWS_AS(solver_type(f, 0.0, x, {.relative = nan}), bad_argument);
  CHECK_THROWS_AS(solver_type(f, nan, x), bad_argument);
  CHECK_THROWS_AS(solver.integrate(inf), bad_argument);
}

}  // namespace bdf_problems_test
