#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include <limits>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "digits50.hpp"
#include "integrators/any_system.hpp"

namespace stiff_one_step_use_test {

// How one-step methods for stiff systems are used, and how they fail.

using namespace kte;
using test::any_system, test::contains_text, test::numbers;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using state = Eigen::VectorXd;
constexpr auto oscillator = [](double, const auto& x) { return Eigen::Vector2d(x[1], -x[0]); };

template <template <class, class> class Method>
Method<any_system<>, state> make(const any_system<>& f, double t0, const state& x0, double tolerance = 1e-6,
                                 long long max_steps = 100000) {
  return {f, t0, x0, {.absolute = tolerance, .relative = tolerance, .max_steps = max_steps}};
}

/// Whether a method gets from one time to another, forward and back, with few tries.
template <template <class, class> class Method>
bool passes(double from, double to) {
  const any_system<> f([](double t, const state& x) { return numbers(x[1] + std::sin(t), -x[0]); });
  auto there = make<Method>(f, from, numbers(1, 0.5), 1e-6, 1000);
  auto back = make<Method>(f, to, numbers(1, 0.5), 1e-6, 1000);
  there.integrate(to), back.integrate(from);
  return there.time() == to && back.time() == from && there.state().allFinite() && back.state().allFinite();
}

/// What all steps so far may miss by, each by sqrt(2) times the tolerance of 1e-6 and the weight of a number of this
/// size, where errors do not grow.
template <class Solver>
double missed(const Solver& solver, double size) {
  return std::sqrt(2) * 1e-6 * (1 + size) * static_cast<double>(solver.statistics().steps);
}

template <template <class, class> class Method>
void check_use() {
  auto solver = make<Method>({oscillator}, 1.0, numbers(1, 0));
  double before = 1;
  state x_before = numbers(1, 0);
  solver.integrate(5, [&](double t, const state& x) {
    if (t > before) {
      CHECK(solver.interpolate(before) == x_before);
      CHECK(solver.interpolate(t) == x);
      const double d = (t - before) * 1e-7;  // continuous: |x'| = 1
      CHECK((solver.interpolate(before + d) - x_before).norm() < 2 * d);
      CHECK((solver.interpolate(t - d) - x).norm() < 2 * d);
    }
    before = t, x_before = x;
  });
  solver.begin(6);
  CHECK((solver.interpolate(solver.time() - 1e-3) - solver.state()).norm() < 2e-3);  // still the last step
  solver.integrate(1);                                                               // backward, to the start
  CHECK((solver.state() - Eigen::Vector2d(1, 0)).norm() < missed(solver, 1));
  solver.restart(3, numbers(0, 2));
  solver.integrate(3 + std::acos(-1.0), every(0.25), [&](double t, const state& x) {
    CHECK((x - 2 * Eigen::Vector2d(std::sin(t - 3), std::cos(t - 3))).norm() < missed(solver, 2));
  });
  CHECK(solver.time() == 3 + std::acos(-1.0));
}

/// A step that ends at a jump of f is no reason to go on with the slope, or the Jacobian, from before it.
template <template <class, class> class Method>
void check_changes() {
  double rate = -1e3, input = 1;
  auto solver = make<Method>({[&](double, const state& x) { return numbers(rate * (x[0] - input)); }}, 0.0, numbers(0));
  solver.integrate(1);
  CHECK(solver.state()[0] == within(1.0, 1e-5));
  input = 2;
  solver.integrate(1.0005);
  CHECK(solver.state()[0] == within(2 - std::exp(-0.5), missed(solver, 2)));
  rate = 500;
  solver.integrate(1.0015);  // away from 2, e^0.5 times as far, as are errors
  CHECK(solver.state()[0] == within(2 - std::exp(0.0), 2 * missed(solver, 2)));
}

template <template <class, class> class Method>
void check_failures() {
  auto blown = make<Method>({[](double, const state& x) { return numbers(x[0] * x[0]); }}, 0.0, numbers(1));
  CHECK_THROWS_WITH(blown.integrate(2), contains_text("stopped at t = "));
  CHECK(blown.time() == within(1.0, 0.01));
  CHECK(std::isfinite(blown.state()[0]));
  CHECK(blown.interpolate(blown.time()) == blown.state());

  auto broken = make<Method>({[](double t, const state&) { return numbers(t < 0.5 ? 1.0 : nan); }}, 0.0, numbers(0));
  CHECK_THROWS_WITH(broken.integrate(1), contains_text("t = 0.49999") && contains_text("not a finite number"));
  CHECK(broken.state()[0] == within(broken.time(), missed(broken, 0.5)));
  auto at_once = make<Method>({[](double, const state&) { return numbers(nan); }}, 0.7, numbers(3));
  CHECK_THROWS_WITH(at_once.integrate(1), contains_text("t = 0.69999") && contains_text("not a finite number"));
  CHECK(at_once.state()[0] == 3.0);

  auto few = make<Method>({oscillator}, 0.0, numbers(1, 0), 1e-6, 10);
  CHECK_THROWS_WITH(few.integrate(100), contains_text("max_steps = 10"));
  CHECK(few.statistics().steps + few.statistics().rejected == 10);
  CHECK_THROWS_WITH(make<Method>({oscillator}, 0.0, numbers(1, 0), -0.25), contains_text("got -0.25"));
  CHECK_THROWS_AS(make<Method>({oscillator}, nan, numbers(1, 0)), bad_argument);
}

/// x' = x with a Jacobian that is told.
any_system<> told(double value) {
  return {[](double, const state& x) { return x; },
          [value](double, const state&, Eigen::MatrixXd& J) { J(0, 0) = value; }};
}
template <template <class, class> class Method>
void check_bad_jacobian() {
  auto solver = make<Method>(told(nan), 0.0, numbers(1));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("the Jacobian has a number that is not finite"));
  CHECK(solver.state()[0] == 1.0);
}
/// W = 0 exactly in the first step, which goes to the end: it is tried again, shorter.
template <template <class, class> class Method>
void check_singular(double gamma) {
  const double end = 1.0 / 1048576;
  auto solver = make<Method>(told(1 / (gamma * end)), 0.0, numbers(1), 1e30);
  solver.integrate(end);
  CHECK(solver.statistics().rejected > 0);
  CHECK(solver.state()[0] == within(1.0, 1e-4));
}

template <class S, template <class, class> class Method>
S decayed(const S& tolerance) {
  using X = Eigen::Matrix<S, 1, 1>;
  const auto f = [](const S&, const X& x) { return X(-x); };
  Method<decltype(f), X> solver(f, S(0), X(S(1)), {tolerance, tolerance});
  solver.integrate(S(1));
  return solver.state()[0];
}
/// Methods of order 2 take some 100 steps at 1e-8, and each may miss by that.
template <template <class, class> class Method>
void check_scalars() {
  using real50 = kte::test::digits50;
  CHECK(decayed<float, Method>(1e-4f) == within(std::exp(-1.0), 1e-3));
  CHECK(static_cast<double>(decayed<long double, Method>(1e-8L) - std::exp(-1.0L)) == within(0.0, 2e-6));
  CHECK(static_cast<double>(decayed<real50, Method>(1e-8) - exp(real50(-1))) == within(0.0, 2e-6));
}

template <template <class, class> class Method>
void check_dynamic() {
  auto solver = make<Method>({[](double, const state& x) -> state { return -1e4 * x; }}, 0.0, state::Ones(3));
  solver.integrate(1e-4);
  CHECK((solver.state().array() - std::exp(-1.0)).abs().maxCoeff() < 1e-4);
}

TEST_CASE("one-step methods for stiff systems: forward, backward, again, and between steps") {
  SECTION("rosenbrock23") { check_use<rosenbrock23>(); }
  SECTION("RODAS") { check_use<rodas>(); }
  SECTION("TR-BDF2") { check_use<tr_bdf2>(); }
  SECTION("trapezoidal rule") { check_use<trapezoidal>(); }
  SECTION("Kennedy and Carpenter") { check_use<kennedy_carpenter34>(); }
}

TEST_CASE("one-step methods for stiff systems: the right-hand side may change between calls") {
  SECTION("rosenbrock23") { check_changes<rosenbrock23>(); }
  SECTION("RODAS") { check_changes<rodas>(); }
  SECTION("TR-BDF2") { check_changes<tr_bdf2>(); }
  SECTION("trapezoidal rule") { check_changes<trapezoidal>(); }
  SECTION("Kennedy and Carpenter") { check_changes<kennedy_carpenter34>(); }
}

TEST_CASE("one-step methods for stiff systems: failures") {
  SECTION("rosenbrock23") { check_failures<rosenbrock23>(), check_bad_jacobian<rosenbrock23>(); }
  SECTION("RODAS") { check_failures<rodas>(), check_bad_jacobian<rodas>(), check_singular<rodas>(0.25); }
  SECTION("TR-BDF2") { check_failures<tr_bdf2>(), check_bad_jacobian<tr_bdf2>(); }
  SECTION("trapezoidal rule") {
    check_failures<trapezoidal>(), check_bad_jacobian<trapezoidal>(), check_singular<trapezoidal>(0.5);
  }
  SECTION("Kennedy and Carpenter") {
    check_failures<kennedy_carpenter34>(), check_bad_jacobian<kennedy_carpenter34>(),
        check_singular<kennedy_carpenter34>(0.25);
  }
}

TEST_CASE("one-step methods for stiff systems: scalars and dynamic sizes") {
  SECTION("rosenbrock23") { check_scalars<rosenbrock23>(), check_dynamic<rosenbrock23>(); }
  SECTION("RODAS") { check_scalars<rodas>(), check_dynamic<rodas>(); }
  SECTION("TR-BDF2") { check_scalars<tr_bdf2>(), check_dynamic<tr_bdf2>(); }
  SECTION("trapezoidal rule") { check_scalars<trapezoidal>(), check_dynamic<trapezoidal>(); }
  SECTION("Kennedy and Carpenter") { check_scalars<kennedy_carpenter34>(), check_dynamic<kennedy_carpenter34>(); }
}

TEST_CASE("one-step methods for stiff systems: types follow from arguments") {
  const Eigen::Vector2d x(1, 0);
  rosenbrock23 a(oscillator, 0.0, x, {.absolute = 1e-4, .relative = 1e-4});
  rodas b(oscillator, 0.0, x);
  tr_bdf2 c(oscillator, 0.0, 2 * x, {.absolute = Eigen::Vector2d(1e-4, 1e-5)});
  trapezoidal d(oscillator, 0.0, x);
  kennedy_carpenter34 e(oscillator, 0.0, x);
  a.integrate(1), b.integrate(1), c.integrate(1), d.integrate(1), e.integrate(1);
  CHECK(c.state()[0] == within(2 * std::cos(1.0), 1e-3));
}

TEST_CASE("intervals of subnormal length, or of one rounding, are passed through") {
  const double eps = std::numeric_limits<double>::epsilon();
  const std::vector<std::pair<double, double>> intervals{{0, 1e-320}, {0, 5e-324},      {1e-320, 3e-320},
                                                         {0, 1e-310}, {5e-324, 1e-300}, {1, 1 + eps}};
  for (const auto& [from, to] : intervals) {
    CAPTURE(from, to);
    CHECK(passes<rodas>(from, to));
    CHECK(passes<rosenbrock23>(from, to));
  }
}

}  // namespace stiff_one_step_use_test
