#include <kte/adapters/sundials.hpp>

#include "catch.hpp"

namespace sundials_stiff_test {

using namespace kte;

/// mu = 1000, from (2, 0).
struct van_der_pol {
  static constexpr double mu = 1000;
  Eigen::Vector2d operator()(double, const Eigen::Vector2d& x) const {
    return {x[1], mu * (1 - x[0] * x[0]) * x[1] - x[0]};
  }
};
struct van_der_pol_with_jacobian : van_der_pol {
  long long* calls;
  double factor = 1;  ///< 1: right
  template <class M>
  void jacobian(const double&, const Eigen::Vector2d& x, M& j) const {
    ++*calls;
    j << 0, 1, -2 * mu * x[0] * x[1] - 1, mu * (1 - x[0] * x[0]);
    j *= factor;
  }
};
/// At t = 2000: Mazzia and Magherini, Test set for initial value problem solvers, 2008, II-10, in its scale 2 and
/// 1/1000.
const Eigen::Vector2d at_2000(1.7061677321704650085, -8.9280970102481654778e-4);
const Eigen::Vector2d start(2, 0);

template <template <class, class> class Solver>
void check_van_der_pol(double tolerance) {
  const tolerances<double> tol{.absolute = Eigen::Vector2d(tolerance, tolerance / 1000), .relative = tolerance};
  const auto solve = [&]<class F>(const F& f, double error = 1e-5) {
    Solver<F, Eigen::Vector2d> solver(f, 0.0, start, tol);
    solver.integrate(2000);
    CHECK(solver.state()[0] == within_relative(at_2000[0], error));
    CHECK(solver.state()[1] == within_relative(at_2000[1], error));
    return solver.statistics();
  };
  long long calls = 0;
  const auto without = solve(van_der_pol{});
  const auto with = solve(van_der_pol_with_jacobian{{}, &calls});
  CHECK(with.jacobians == calls);
  CHECK(with.factorizations >= with.jacobians);
  CHECK(with.jacobians > 10);
  CHECK(with.steps < 10000);
  CHECK(without.jacobians > 10);
  CHECK(static_cast<double>(with.steps) == within_relative(static_cast<double>(without.steps), 0.1));
  CHECK(2 * with.steps < solve(van_der_pol_with_jacobian{{}, &calls, 0.7}, 0.01).steps);  // it is used
}

TEST_CASE("SUNDIALS: stiff van der Pol, with and without Jacobian") {
  SECTION("bdf") { check_van_der_pol<kte::sundials::bdf>(1e-9); }
  SECTION("implicit Runge-Kutta") { check_van_der_pol<kte::sundials::implicit_runge_kutta>(1e-7); }
}

TEST_CASE("SUNDIALS: backward in time, the Jacobian of implicit Runge-Kutta methods has the other sign") {
  long long calls = 0;
  const auto solve = [&](auto f) {
    const tolerances<double> tol{.absolute = 1e-9, .relative = 1e-9};
    kte::sundials::implicit_runge_kutta solver(f, 0.0, Eigen::Vector2d(0.5, 0), tol);
    solver.integrate(0.01);
    const auto steps = solver.statistics().steps;
    solver.integrate(0);
    CHECK((solver.state() - Eigen::Vector2d(0.5, 0)).norm() < 1e-6);
    return solver.statistics().steps - steps;
  };
  CHECK(solve(van_der_pol_with_jacobian{{}, &calls}) == solve(van_der_pol{}));
  CHECK(calls > 0);
}

/// Robertson's reactions: Hairer and Wanner, II-12, with its reference at t = 1e11.
struct robertson {
  Eigen::Vector3d operator()(double, const Eigen::Vector3d& x) const {
    const double a = 0.04 * x[0], b = 1e4 * x[1] * x[2], c = 3e7 * x[1] * x[1];
    return {b - a, a - b - c, c};
  }
  template <class M>
  void jacobian(const double&, const Eigen::Vector3d& x, M& j) const {
    j << -0.04, 1e4 * x[2], 1e4 * x[1],               //
        0.04, -1e4 * x[2] - 6e7 * x[1], -1e4 * x[1],  //
        0, 6e7 * x[1], 0;
  }
};

TEST_CASE("SUNDIALS: Robertson's reactions over eleven decades") {
  const tolerances<double> tol{.absolute = Eigen::Vector3d(1e-14, 1e-20, 1e-14), .relative = 1e-8};
  kte::sundials::bdf solver(robertson{}, 0.0, Eigen::Vector3d(1, 0, 0), tol);
  solver.integrate(1e11);
  CHECK(solver.state()[0] == within_relative(2.083340149701255e-8, 1e-4));
  CHECK(solver.state()[1] == within_relative(8.333360770334713e-14, 1e-4));
  CHECK(solver.state()[2] == within_relative(0.999999979166505, 1e-9));
  CHECK(solver.statistics().evaluations < 10000);
}

}  // namespace sundials_stiff_test
