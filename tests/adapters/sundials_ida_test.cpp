#include <kte/adapters/sundials.hpp>

#include "catch.hpp"

namespace sundials_ida_test {

using namespace kte;
using kte::test::contains_text;

using scalar_state = Eigen::Matrix<double, 1, 1>;
using vector5 = Eigen::Matrix<double, 5, 1>;

/// A mass on a rod of 0.5 m in 9.81 m/s^2: position, velocity and force of the rod a mass and a length, l. The length
/// is differentiated twice, which makes the index 1:
///
///   p' = v,  v' = -l p - g,  0 = v.v - l p.p - g.p
struct pendulum {
  static constexpr double g = 9.81;
  vector5 operator()(double, const vector5& x, const vector5& x_dot) const {
    vector5 r;
    r << x_dot[0] - x[2], x_dot[1] - x[3], x_dot[2] + x[4] * x[0], x_dot[3] + x[4] * x[1] + g,
        x[2] * x[2] + x[3] * x[3] - x[4] * (x[0] * x[0] + x[1] * x[1]) - g * x[1];
    return r;
  }
};
struct pendulum_with_jacobian : pendulum {
  long long* calls;
  void jacobian(double, const vector5& x, const vector5&, double c, Eigen::Matrix<double, 5, 5>& j) const {
    ++*calls;
    j << c, 0, -1, 0, 0,      //
        0, c, 0, -1, 0,       //
        x[4], 0, c, 0, x[0],  //
        0, x[4], 0, c, x[1],  //
        -2 * x[4] * x[0], -2 * x[4] * x[1] - g, 2 * x[2], 2 * x[3], -x[0] * x[0] - x[1] * x[1];
  }
};
const vector5 differential = (vector5() << 1, 1, 1, 1, 0).finished();
const vector5 guess = (vector5() << 0.5, 0, 0, 0, 7).finished();  // horizontal, at rest; the force is unknown
constexpr double theta10 = 1.55012648485020447245734549;          // the angle after 10 s, by elliptic functions

template <class F>
void check_pendulum(const F& f) {
  kte::sundials::ida solver(f, 0.0, guess, vector5::Zero(), {.absolute = 1e-11, .relative = 1e-11});
  solver.make_consistent(differential, 10.0);
  CHECK(solver.time() == 0);
  CHECK(solver.state()[4] == within(0.0, 1e-9));
  CHECK(solver.derivative()[3] == within_relative(-9.81, 1e-9));
  CHECK((solver.state() - guess).cwiseProduct(differential) == vector5::Zero());
  const auto of_start = solver.statistics();
  CHECK(of_start.steps == 0);
  CHECK(of_start.jacobians > 0);
  solver.integrate(10);
  CHECK(solver.time() == 10);
  CHECK(solver.state()[0] == within(0.5 * std::sin(theta10), 1e-6));
  CHECK(solver.state()[1] == within(-0.5 * std::cos(theta10), 1e-6));
  CHECK(std::hypot(solver.state()[0], solver.state()[1]) == within(0.5, 1e-6));
  CHECK(f(10, solver.state(), solver.derivative()).norm() < 1e-6);
  CHECK(solver.statistics().jacobians > of_start.jacobians);
  CHECK(solver.statistics().steps > 100);
}

TEST_CASE("IDA: a pendulum as an equation of index 1, from a start that is a guess") {
  check_pendulum(pendulum{});
  long long calls = 0;
  check_pendulum(pendulum_with_jacobian{{}, &calls});
  CHECK(calls > 10);
}

TEST_CASE("IDA: Robertson's reactions, with a balance instead of the third, over eleven decades") {
  const auto f = [](double, const Eigen::Vector3d& x, const Eigen::Vector3d& x_dot, Eigen::Vector3d& r) {
    const double a = 0.04 * x[0], b = 1e4 * x[1] * x[2], c = 3e7 * x[1] * x[1];
    r << x_dot[0] + a - b, x_dot[1] - a + b + c, x[0] + x[1] + x[2] - 1;
  };
  const tolerances<double> tol{.absolute = Eigen::Vector3d(1e-14, 1e-20, 1e-14), .relative = 1e-8};
  kte::sundials::ida solver(f, 0.0, Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-0.04, 0.04, 0), tol);
  solver.integrate(1e11);  // reference: Mazzia and Magherini, Test set for initial value problem solvers, 2008, II-12
  CHECK(solver.state()[0] == within_relative(2.083340149701255e-8, 1e-4));
  CHECK(solver.state()[1] == within_relative(8.333360770334713e-14, 1e-4));
  CHECK(solver.state()[2] == within_relative(0.999999979166505, 1e-9));
}

constexpr auto oscillator = [](double, const Eigen::VectorXd& x, const Eigen::VectorXd& v) -> Eigen::VectorXd {
  return Eigen::Vector2d(v[0] - x[1], v[1] + x[0]);
};
Eigen::Vector2d exact(double t) { return {std::cos(t), -std::sin(t)}; }
Eigen::Vector2d slope(double t) { return {-std::sin(t), -std::cos(t)}; }

TEST_CASE("IDA: exact ends forward and backward, samples, restart") {
  kte::sundials::ida solver(oscillator, 0.0, Eigen::VectorXd(exact(0)), slope(0), {.absolute = 1e-9, .relative = 1e-9});
  for (double end : {1e-18, 3.0, -2.0, 5.0}) {
    solver.integrate(end, every(0.1), [](double t, const auto& x) { REQUIRE((x - exact(t)).norm() < 1e-6); });
    CHECK(solver.time() == end);
    CHECK((solver.derivative() - slope(end)).norm() < 1e-6);
  }
  solver.restart(1, 2 * exact(1), 2 * slope(1));
  CHECK(solver.time() == 1);
  CHECK(solver.derivative() == 2 * slope(1));
  solver.integrate(2);
  CHECK((solver.state() - 2 * exact(2)).norm() < 1e-6);
}

TEST_CASE("IDA: all of a state from its derivative") {
  kte::sundials::ida solver(oscillator, 0.0, Eigen::VectorXd::Constant(2, 5), slope(1),
                            {.absolute = 1e-9, .relative = 1e-9});
  solver.make_state_consistent(1.0);
  CHECK((solver.state() - exact(1)).norm() < 1e-8);
}

TEST_CASE("IDA: initial, largest and smallest steps are those that were asked for, forward and backward") {
  const auto decay = [](double, const scalar_state& x, const scalar_state& v) { return scalar_state(v[0] + x[0]); };
  tolerances<double> tol{.absolute = 1e-3, .relative = 1e-3};
  tol.initial_step = 1e-6;
  tol.largest_step = 0.02;
  kte::sundials::ida solver(decay, 0.0, scalar_state(1.0), scalar_state(-1.0), tol);
  for (double end : {1.0, 0.0}) {
    double last = solver.time(), first = 0;
    solver.integrate(end, [&](double t, const auto&) {
      CHECK(std::abs(t - last) <= 0.02 + 1e-14);
      if (first == 0) first = std::abs(t - last);
      last = t;
    });
    CHECK(first == within(1e-6, 1e-14));
  }
  tol = {.absolute = 1e-12, .relative = 1e-12};
  tol.smallest_step = 0.1;
  kte::sundials::ida coarse(decay, 0.0, scalar_state(1.0), scalar_state(-1.0), tol);
  CHECK_THROWS_WITH(coarse.integrate(10), contains_text("stopped at t = 0: ") && contains_text("hmin"));
}

TEST_CASE("IDA: failures") {
  const auto none = [](double, const scalar_state& x, const scalar_state&) { return scalar_state(x[0] * x[0] + 1); };
  kte::sundials::ida solver(none, 0.0, scalar_state(1.0), scalar_state(0.0));
  CHECK_THROWS_WITH(solver.make_consistent(scalar_state(0.0), 1.0), contains_text("stopped at t = 0: IDA_"));
  CHECK_THROWS_WITH(solver.integrate(1), contains_text("stopped at t = 0: IDA_"));
  CHECK(solver.state()[0] == 1);
  CHECK(solver.derivative()[0] == 0);

  double wall = 0.3;
  const auto thrower = [&](double t, const scalar_state&, const scalar_state& v) {
    if (t > wall) throw std::domain_error("wall");
    return scalar_state(v[0] - 1);
  };
  kte::sundials::ida thrown(thrower, 0.0, scalar_state(0.0), scalar_state(1.0));
  CHECK_THROWS_AS(thrown.integrate(1), std::domain_error);
  CHECK(thrown.state()[0] == within(thrown.time(), 1e-13));  // exact at every order, so rounding
  wall = 2;
  thrown.integrate(1);
  CHECK(thrown.state()[0] == within(1.0, 1e-13));

  const auto nan = [](double t, const scalar_state&, const scalar_state& v) {
    return scalar_state(t < 0.5 ? v[0] - 1 : std::nan(""));
  };
  kte::sundials::ida bad(nan, 0.0, scalar_state(0.0), scalar_state(1.0));
  CHECK_THROWS_WITH(bad.integrate(1), contains_text("t = 0.49999") && contains_text("f is not finite"));
  CHECK_THROWS_WITH(bad.restart(0, scalar_state(0.0), Eigen::VectorXd::Zero(2)),
                    contains_text("2 numbers for a state of 1"));
  CHECK_THROWS_AS(bad.restart(0, scalar_state(0.0), scalar_state(std::nan(""))), bad_argument);
}

}  // namespace sundials_ida_test
