#include <kte/adapters/sundials.hpp>

#include <string>
#include <vector>

#include "catch.hpp"

namespace sundials_test {

using namespace kte;
using kte::test::contains_text;

using scalar_state = Eigen::Matrix<double, 1, 1>;
constexpr auto oscillator = [](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -x[0]); };
Eigen::Vector2d exact(double t) { return {std::cos(t), -std::sin(t)}; }
const Eigen::Vector2d start(1, 0);

/// Calls run(solver) with a new solver of each kind.
template <class F, class X, class Run>
void with_each(const F& f, double t0, const X& x0, const tolerances<double>& tol, const Run& run) {
  kte::sundials::bdf bdf(f, t0, x0, tol);
  kte::sundials::adams adams(f, t0, x0, tol);
  kte::sundials::explicit_runge_kutta dormand_prince(f, t0, x0, tol);
  kte::sundials::implicit_runge_kutta kvaerno(f, t0, x0, tol);
  SECTION("bdf") { run(bdf); }
  SECTION("adams") { run(adams); }
  SECTION("explicit Runge-Kutta") { run(dormand_prince); }
  SECTION("implicit Runge-Kutta") { run(kvaerno); }
}

TEST_CASE("SUNDIALS: errors follow the tolerance, at steps and between them") {
  for (double tol : {1e-6, 1e-9}) {
    with_each(oscillator, 0.0, start, {.absolute = tol, .relative = tol}, [&](auto& solver) {
      solver.integrate(10, every(0.03), [&](double t, const auto& x) {
        REQUIRE((x - exact(t)).norm() < 200 * tol);  // hundreds of steps, each within the tolerance
      });
      CHECK(solver.time() == 10.0);
      CHECK(solver.statistics().steps < 1000);
    });
  }
}

TEST_CASE("SUNDIALS: they land exactly on the end, forward and backward, however far it is") {
  with_each(oscillator, 5.0, start, {.absolute = 1e-9, .relative = 1e-9}, [](auto& solver) {
    for (int i = 1; i <= 100; ++i) {
      const double end = 5 + i * 0.0137;
      solver.integrate(end);
      REQUIRE(solver.time() == end);
    }
    CHECK((solver.state() - exact(1.37)).norm() < 1e-6);
    for (double end : {std::nextafter(solver.time(), 100.0), solver.time() - 1e-15, 4.0, -5.0, -5.0, 5.0}) {
      solver.integrate(end);
      REQUIRE(solver.time() == end);
      CHECK((solver.state() - exact(end - 5)).norm() < 1e-6);
    }
    CHECK(solver.statistics().steps < 4000);
  });
}

TEST_CASE("SUNDIALS: samples are those of interpolate, and do not change the steps") {
  const tolerances<double> tol{.absolute = 1e-6, .relative = 1e-6};
  std::vector<Eigen::Vector2d> sampled, interpolated;
  std::vector<double> steps, steps_with_samples;
  with_each(oscillator, 0.0, start, tol, [&](auto& solver) {
    solver.integrate(3, every(0.25), [&](double, const auto& x) { sampled.push_back(x); });
    const auto with_samples = solver.state();
    solver.restart(0, start);
    interpolated.push_back(start);
    double before = 0;
    solver.integrate(3, [&](double t, const Eigen::Vector2d& x) {
      for (int i = 1; i <= 12; ++i)
        if (before < i * 0.25 && i * 0.25 <= t) interpolated.push_back(solver.interpolate(i * 0.25));
      CHECK(solver.interpolate(t) == x);
      before = t;
    });
    CHECK(sampled == interpolated);
    CHECK(sampled.size() == 13);
    CHECK(solver.state() == with_samples);
    CHECK_THROWS_AS(solver.interpolate(0.0), bad_argument);
  });
}

TEST_CASE("SUNDIALS: the caller takes the steps") {
  with_each(oscillator, 0.0, start, {}, [](auto& solver) {
    solver.integrate(3);
    const auto state = solver.state();
    solver.restart(0, start);
    for (solver.begin(3); solver.time() != 3;) {
      const double before = solver.time();
      solver.step(3);
      CHECK(solver.time() > before);
    }
    CHECK(solver.state() == state);
    solver.begin(2);  // the step that is over was one forward
    CHECK(solver.interpolate(3) == state);
    CHECK_THROWS_AS(solver.interpolate(std::nextafter(3.0, 0.0)), bad_argument);
    solver.step(2);
    CHECK(solver.interpolate((3 + solver.time()) / 2)[0] == within(std::cos((3 + solver.time()) / 2), 1e-4));
  });
}

TEST_CASE("SUNDIALS: after a jump of the state by restart, after a jump of f without") {
  double gravity = 0;
  const auto fall = [&](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], -gravity); };
  with_each(fall, 0.0, Eigen::Vector2d(0, 2), {.absolute = 1e-8, .relative = 1e-8}, [&](auto& solver) {
    gravity = 0;
    solver.integrate(1);
    gravity = 10;
    solver.integrate(1.5);
    CHECK(solver.state()[0] == within(2 + 1 - 1.25, 1e-6));
    CHECK(solver.state()[1] == within(-3.0, 1e-6));
    const auto before = solver.statistics();
    solver.restart(7, Eigen::Vector2d(0, 3));  // bounces
    CHECK(solver.time() == 7);
    CHECK(solver.interpolate(7) == Eigen::Vector2d(0, 3));
    solver.integrate(7.5);
    CHECK(solver.state()[0] == within(1.5 - 1.25, 1e-6));
    CHECK(solver.state()[1] == within(-2.0, 1e-6));
    CHECK(solver.statistics().steps > before.steps);
    CHECK(solver.statistics().factorizations >= before.factorizations);
  });
}

TEST_CASE("SUNDIALS: every evaluation is counted") {
  long long calls = 0;
  const auto f = [&](double t, const Eigen::Vector2d& x) { return ++calls, oscillator(t, x); };
  with_each(f, 0.0, start, {}, [&](auto& solver) {
    calls = 0;
    CHECK(solver.statistics().evaluations == 0);
    solver.integrate(3);
    solver.restart(0, start);
    solver.integrate(3, every(0.01), [](double, const auto&) {});
    CHECK(solver.statistics().evaluations == calls);
    CHECK(solver.statistics().evaluations > solver.statistics().steps);
  });
}

TEST_CASE("SUNDIALS: tolerances hold for each component") {
  const auto f = [](double t, const Eigen::Vector2d& x) { return Eigen::Vector2d(-x[0], 50 * std::cos(50 * t)); };
  const auto solve = [&](const tolerances<double>& tol, double error) {
    kte::sundials::bdf solver(f, 0.0, Eigen::Vector2d(1, 0), tol);
    solver.integrate(3);
    CHECK(solver.state()[0] == within(std::exp(-3), error));
    return std::pair{solver.statistics().steps, solver.state()};
  };
  using each = Eigen::Vector2d;
  const auto all = solve({.absolute = 1e-6, .relative = 1e-6}, 1e-4);
  CHECK(solve({.absolute = each(1e-6, 1e-6), .relative = each(1e-6, 1e-6)}, 1e-4) == all);
  CHECK(10 * solve({.absolute = each(1e-6, 1e6), .relative = 1e-6}, 1e-4).first < all.first);
  CHECK(10 * solve({.absolute = 1e-30, .relative = each(1e-6, 1e6)}, 1e-4).first < all.first);
  CHECK(2 * solve({.absolute = each(1, 1e-6), .relative = each(1, 1e-6)}, 1).first > all.first);
  CHECK_THROWS_WITH(solve({.absolute = Eigen::Vector3d(1, 1, 1)}, 1), contains_text("3 numbers, for 2 components"));
  CHECK_THROWS_WITH(solve({.relative = each(1, -1)}, 1), contains_text("relative tolerance of component 1"));
}

TEST_CASE("SUNDIALS: initial, largest and smallest steps are those that were asked for, forward and backward") {
  const auto steps = [](auto& solver, double end) {
    std::vector<double> lengths;
    double last = solver.time();
    solver.integrate(end, [&](double t, const auto&) {
      if (t != last) lengths.push_back(std::abs(t - last));
      last = t;
    });
    return lengths;
  };
  const double rounding = 1e-14;  // of times
  tolerances<double> tol{.absolute = 1e-3, .relative = 1e-3};
  tol.initial_step = 1e-6;
  tol.largest_step = 0.02;
  with_each(oscillator, 0.0, start, tol, [&](auto& solver) {
    for (double end : {1.0, -1.0}) {
      const auto lengths = steps(solver, end);
      CHECK(std::abs(lengths.front() - 1e-6) < rounding);
      for (double h : lengths) CHECK(h <= 0.02 + rounding);
    }
    solver.restart(3, start);
    CHECK(std::abs(steps(solver, 4).front() - 1e-6) < rounding);
  });
  tol = {.absolute = 1e-2, .relative = 1e-2};
  tol.smallest_step = 0.01;
  with_each(oscillator, 0.0, start, tol, [&](auto& solver) {
    auto lengths = steps(solver, 1.2345);
    lengths.pop_back();  // may be shorter
    for (double h : lengths) CHECK(h >= 0.01 - rounding);
  });
  tol.absolute = tol.relative = 1e-12;
  tol.smallest_step = 0.1;
  with_each(oscillator, 0.0, start, tol, [&](auto& solver) {
    CHECK_THROWS_WITH(solver.integrate(10), contains_text("stopped at t = 0: ") && contains_text("hmin"));
  });
}

TEST_CASE("SUNDIALS: dynamic states, right-hand sides by reference") {
  struct decay {
    Eigen::VectorXd out;
    const Eigen::VectorXd& operator()(double, const Eigen::VectorXd& x) { return out = -x; }
  } f;
  with_each(std::ref(f), 0.0, Eigen::VectorXd::Ones(5), {.absolute = 1e-9, .relative = 1e-9}, [&](auto& solver) {
    solver.integrate(1);
    CHECK((solver.state().array() - std::exp(-1.0)).abs().maxCoeff() < 1e-7);
    CHECK(f.out.size() == 5);
    CHECK_THROWS_WITH(solver.restart(0, Eigen::VectorXd::Ones(4)), contains_text("4 numbers of a state of 5"));
    CHECK(solver.time() == 1);
  });
}

TEST_CASE("SUNDIALS: Runge-Kutta tables have their orders") {
  const auto f = [](double t, const scalar_state& x) { return scalar_state(-2 * t * x[0] * x[0]); };  // 1 / (1 + t^2)
  const auto order = [&]<class Solver>(Solver& solver, double h) {
    double errors[2];
    for (int i = 0; i < 2; ++i) {
      solver.restart(0, scalar_state(1.0));
      ARKStepSetFixedStep(solver.memory(), i == 0 ? h : h / 2);
      solver.integrate(2);
      errors[i] = std::abs(solver.state()[0] - 0.2);
    }
    return std::log2(errors[0] / errors[1]);
  };
  const auto of_explicit = [&](ARKODE_ERKTableID table, double h) {
    kte::sundials::explicit_runge_kutta solver(f, 0.0, scalar_state(1.0), {}, table);
    return order(solver, h);
  };
  const auto of_implicit = [&](ARKODE_DIRKTableID table, double h) {
    const tolerances<double> tight{.absolute = 1e-12, .relative = 1e-12};  // of Newton's method; the step is fixed
    kte::sundials::implicit_runge_kutta solver(f, 0.0, scalar_state(1.0), tight, table);
    ARKStepSetMaxNonlinIters(solver.memory(), 20);
    return order(solver, h);
  };
  CHECK(of_explicit(ARKODE_HEUN_EULER_2_1_2, 1.0 / 32) == within(2, 0.15));
  CHECK(of_explicit(ARKODE_BOGACKI_SHAMPINE_4_2_3, 1.0 / 32) == within(3, 0.15));
  CHECK(of_explicit(ARKODE_DORMAND_PRINCE_7_4_5, 1.0 / 32) == within(5, 0.3));
  CHECK(of_explicit(ARKODE_VERNER_8_5_6, 1.0 / 16) == within(6, 0.3));
  CHECK(of_implicit(ARKODE_TRBDF2_3_3_2, 1.0 / 64) == within(2, 0.15));
  CHECK(of_implicit(ARKODE_KVAERNO_5_3_4, 1.0 / 32) == within(4, 0.3));
}

}  // namespace sundials_test
