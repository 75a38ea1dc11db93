#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "catch.hpp"
#include "integrators/any_system.hpp"
#include "integrators/implicit_conditions.hpp"
#include "integrators/rotating_body.hpp"

namespace stiff_one_step_test {

using namespace kte;
using test::any_system, test::numbers;

/// Nonlinear, and it depends on time; no method's estimate of the error has a zero, as both numbers turn:
///
///   x' = (1 + t) (-x_2, x_1) - t |x|^2 x,   x(0) = (1, 0)
///   x(t) = (cos p, sin p) / sqrt(1 + t^2),   p = t + t^2 / 2
struct spiral {
  using S = long double;
  using state = Eigen::Matrix<S, 2, 1>;
  using matrix = Eigen::Matrix<S, 2, 2>;

  static state at(S t) {
    const S p = t + t * t / 2;
    return state(std::cos(p), std::sin(p)) / std::sqrt(1 + t * t);
  }
  state operator()(S t, const state& x) const { return (1 + t) * state(-x[1], x[0]) - t * x.squaredNorm() * x; }
  void jacobian(S t, const state& x, matrix& J) const {
    J << 0, -1 - t, 1 + t, 0;
    J -= t * (x.squaredNorm() * matrix::Identity() + 2 * x * x.transpose());
  }
  void time_derivative(S, const state& x, state& f_t) const { f_t = state(-x[1], x[0]) - x.squaredNorm() * x; }
};

/// What Newton's iterations leave adds up over the steps, below the tolerance, but above an error of order 4: so its
/// order shows where they leave less.
struct tight_tableau : kennedy_carpenter34_tableau {
  static constexpr ratio newton_tolerance{1, 1000000};
};
template <class F, class X>
struct tight_kennedy_carpenter34 : esdirk<tight_tableau, F, X> {
  using esdirk<tight_tableau, F, X>::esdirk;
};

struct errors {
  long double steps, at_end, between;
};
template <template <class, class> class Method>
errors of_spiral(long double tolerance) {
  using S = long double;
  Method<spiral, spiral::state> solver(spiral{}, 0.0L, spiral::at(0), {tolerance, tolerance});
  S squares = 0;
  solver.integrate(2.0L, every(1 / 1024.0L), [&](S t, const auto& x) { squares += (x - spiral::at(t)).squaredNorm(); });
  return {static_cast<S>(solver.statistics().steps), (solver.state() - spiral::at(2)).norm(), std::sqrt(squares)};
}
double slope(const errors& coarse, const errors& fine, long double errors::*which) {
  return static_cast<double>(std::log(coarse.*which / fine.*which) / std::log(fine.steps / coarse.steps));
}
template <template <class, class> class Method>
void check_order(int order, int order_of_error, long double tolerance) {
  const errors coarse = of_spiral<Method>(tolerance), fine = of_spiral<Method>(tolerance / 1000);
  CAPTURE(static_cast<double>(coarse.at_end), static_cast<double>(coarse.steps));
  CHECK(slope(coarse, fine, &errors::at_end) == within(order, 0.1));
  CHECK(slope(coarse, fine, &errors::between) == within(order, 0.1));
  CHECK(static_cast<double>(std::log(fine.steps / coarse.steps) / std::log(1000)) ==
        within(1.0 / order_of_error, 0.02));  // of a step, kept at the tolerance
  CHECK(coarse.at_end < coarse.steps * tolerance);
}

/// What one step of length 1 makes of 1, in x' = z x.
template <template <class, class> class Method>
double growth(double z) {
  Method<any_system<>, Eigen::VectorXd> solver({[z](double, const auto& x) { return numbers(z * x[0]); }}, 0.0,
                                               numbers(1), {.absolute = 1e30, .relative = 1e30});
  solver.integrate(1e3);
  solver.restart(0, numbers(1), keep_step);
  const auto before = solver.statistics().steps;
  solver.integrate(1);
  REQUIRE(solver.statistics().steps == before + 1);
  return solver.state()[0];
}
/// R(z) by weights B and b; to the rounding of z times the Jacobian's error, where that is by differences.
template <template <class, class> class Method, class M, class V>
void check_growth(const M& B, const V& b) {
  using method = test::implicit_method<static_cast<std::size_t>(M::RowsAtCompileTime)>;
  for (double z : {-1.0, -100.0, -1e4, -1e6})
    CHECK(growth<Method>(z) == within(method{B, B}.growth(b, z).real(), 1e-6));
}
template <template <class, class> class Method, class Tableau>
void check_growth_esdirk() {
  const auto A = test::matrix_of(Tableau::template table<test::real50>().a);
  check_growth<Method>(A, decltype(A.row(0).transpose().eval())(A.row(A.rows() - 1)));
}
template <template <class, class> class Method, class Coefficients>
void check_growth_rosenbrock() {
  const auto k = Coefficients::template table<test::real50>();
  const auto c = test::matrix_of(k.c);
  const decltype(test::matrix_of(k.c)) Gamma = (c.Identity() / k.gamma - c).inverse();
  const decltype(test::matrix_of(k.c)) B = test::matrix_of(k.a) * Gamma + Gamma;
  check_growth<Method>(B, decltype(test::vector_of(k.m))(Gamma.transpose() * test::vector_of(k.m)));
}

/// x' = -1e6 (x - cos t) - sin t: x falls to cos t within 1e-6 s, then follows it.
template <template <class, class> class Method>
Method<any_system<>, Eigen::VectorXd> stiff_solver(double start) {
  const auto f = [](double t, const auto& x) { return numbers(-1e6 * (x[0] - std::cos(t)) - std::sin(t)); };
  return {any_system<>(f), 0.0, numbers(start), {.absolute = 1e-6, .relative = 1e-6}};
}
template <template <class, class> class Method>
void check_stiff(long long most_steps) {
  auto solver = stiff_solver<Method>(2);
  solver.integrate(10);
  CHECK(solver.state()[0] == within(std::cos(10.0), 1e-5));
  CHECK(solver.statistics().steps < most_steps);  // explicit methods need 1e6 at least
  const auto steps = solver.statistics().steps;
  solver.integrate(10.001);  // continues as in one call: an equally long step, unless it ends before
  CHECK(solver.statistics().steps == steps + 1);
  solver.integrate(20);
  CHECK(solver.state()[0] == within(std::cos(20.0), 1e-5));
  CHECK(solver.statistics().steps < 2 * most_steps);
}

/// Steps that differ by less than what makes new factors worth while: the old ones do, with a correction more.
template <template <class, class> class Method>
void check_old_factors() {
  auto solver = stiff_solver<Method>(1);
  solver.integrate(20);
  const long long before = solver.statistics().factorizations;
  for (int i = 0; i < 100; ++i) {
    solver.integrate(solver.time() + 0.02 * (1 + 0.004 * (i % 3 - 1)));
    CHECK(solver.state()[0] == within(std::cos(solver.time()), 3e-6));
  }
  CHECK(solver.statistics().factorizations < before + 10);
}

template <class S, template <class, class> class Method>
auto turned(S tolerance, S drag = 0) {
  using body = test::rotating_body<S>;
  Method<body, typename body::state> solver(body{drag}, S(0), body::start(), {tolerance, tolerance});
  solver.integrate(S(5));
  return solver;
}
template <template <class, class> class Method>
void check_group(int order, long double tolerance) {
  using S = long double;
  const auto exact = turned<S, dormand_prince45>(1e-15L);
  const auto coarse = turned<S, Method>(tolerance), fine = turned<S, Method>(tolerance / 1000);
  const auto error = [&](const auto& solver) { return (solver.state() - exact.state()).norm(); };
  const auto steps = [](const auto& solver) { return static_cast<S>(solver.statistics().steps); };
  CHECK(static_cast<double>(std::log(error(coarse) / error(fine)) / std::log(steps(fine) / steps(coarse))) ==
        within(order, 0.1));
  CHECK(error(coarse) < 3 * steps(coarse) * tolerance);  // errors of the rates grow with time
  // In doubles: each step rounds the norm by about 1e-16, at random, and there are less than 1000.
  const auto rounded = turned<double, Method>(1e-6);
  CHECK(rounded.state().template head<4>().norm() == within_relative(1.0, 1e-14));
  // With a drag that is stiff, the rates are tau / drag, but for 1e-8.
  const auto stiff = turned<double, Method>(1e-6, 1e4);
  const Eigen::Vector3d torque(std::sin(5.0), std::cos(10.0), 0.5);
  CHECK((stiff.state().template tail<3>() - torque / 1e4).norm() < 1e-5);
  CHECK(stiff.state().template head<4>().norm() == within_relative(1.0, 1e-14));
  CHECK(stiff.statistics().steps < 1000);
}

TEST_CASE("one-step methods for stiff systems have their orders, as slopes, at the ends of steps and between them",
          "") {
  SECTION("rosenbrock23") { check_order<rosenbrock23>(2, 3, 1e-7L); }
  SECTION("RODAS") { check_order<rodas>(4, 4, 1e-9L); }
  SECTION("TR-BDF2") { check_order<tr_bdf2>(2, 3, 1e-7L); }
  SECTION("trapezoidal rule") { check_order<trapezoidal>(2, 3, 1e-7L); }
  SECTION("Kennedy and Carpenter") { check_order<tight_kennedy_carpenter34>(4, 4, 1e-9L); }
}

TEST_CASE("a step damps as the stability function says, however stiff: by 1/z, but not the trapezoidal rule") {
  check_growth_rosenbrock<rosenbrock23, rosenbrock23_coefficients>();
  check_growth_rosenbrock<rodas, rodas_coefficients>();
  check_growth_esdirk<tr_bdf2, tr_bdf2_tableau>();
  check_growth_esdirk<trapezoidal, trapezoidal_tableau>();
  check_growth_esdirk<kennedy_carpenter34, kennedy_carpenter34_tableau>();
  for (double R :
       {growth<rosenbrock23>(-1e6), growth<rodas>(-1e6), growth<tr_bdf2>(-1e6), growth<kennedy_carpenter34>(-1e6)})
    CHECK(std::fabs(R) < 1e-5);
  CHECK(growth<trapezoidal>(-1e6) == within_relative(-1.0, 1e-5));
}

TEST_CASE("a stiff linear system takes few steps, also in several calls") {
  // Of order 1 here: Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.15.
  SECTION("rosenbrock23") { check_stiff<rosenbrock23>(6000); }
  SECTION("RODAS") { check_stiff<rodas>(300); }
  SECTION("TR-BDF2") { check_stiff<tr_bdf2>(1000); }
  SECTION("trapezoidal rule") { check_stiff<trapezoidal>(1000); }
  SECTION("Kennedy and Carpenter") { check_stiff<kennedy_carpenter34>(300); }
}

TEST_CASE("diagonally implicit methods use old factors for steps that are nearly as long, but not their old rate") {
  SECTION("TR-BDF2") { check_old_factors<tr_bdf2>(); }
  SECTION("trapezoidal rule") { check_old_factors<trapezoidal>(); }
  SECTION("Kennedy and Carpenter") { check_old_factors<kennedy_carpenter34>(); }
}

TEST_CASE("one-step methods for stiff systems keep rotations on their group, with their order") {
  SECTION("rosenbrock23") { check_group<rosenbrock23>(2, 1e-6L); }
  SECTION("RODAS") { check_group<rodas>(4, 1e-8L); }
  SECTION("TR-BDF2") { check_group<tr_bdf2>(2, 1e-6L); }
  SECTION("trapezoidal rule") { check_group<trapezoidal>(2, 1e-6L); }
  SECTION("Kennedy and Carpenter") { check_group<kennedy_carpenter34>(4, 1e-8L); }
}

}  // namespace stiff_one_step_test
