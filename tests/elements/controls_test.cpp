#include "elements/signal_chains.hpp"

namespace controls_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::signals;

// Controllers, and what they are fed with.

TEST_CASE("an arm on a table that turns, with measures and a controller: static and at run time") {
  const auto c = measured_arm(key_itself, to_static);
  const auto x = measured_arm(text_of_key, to_runtime);
  auto s = make_state(c);
  auto t = x.make_state();
  const vec3<> turn{0.4, -1.2, 0.8}, omega{0.5, 0.4, -0.3}, alpha{-1.1, 2.2, 0.7};
  s[r] = turn, s[w] = omega, s[al] = alpha, s[wanted] = 0.5, s[sum].z = 0.02;
  t.vector("r") = turn, t.vector("w") = omega, t.vector("al") = alpha, t.input("wanted") = 0.5;
  t.internal("sum").z = 0.02;
  const std::array<double, 1> at{0.4}, v{-0.3}, a{1.7};
  set_positions(s, at), set_velocities(s, v), set_accelerations(s, a);
  set_positions(t, at), set_velocities(t, v), set_accelerations(t, a);
  c.doMotion(s), x.doMotion(t);
  const auto& e = s[tool];
  CHECK(near(s[seen_v], e.rotation * e.velocity, 0.0));
  CHECK(near(s[seen_w], e.rotation * e.ang_velocity, 0.0));
  CHECK(near(s[seen_a], e.acceleration, 0.0));
  CHECK(near(matrix(s[seen_r]).y, e.rotation.y, 1e-15));
  CHECK(s[drive] == within(80 * 0.1 + 40 * 0.02 + 6 * 0.3, 1e-14));
  CHECK(s[sum].z_dot == within(0.1, 1e-16));
  CHECK(near(s[table].ang_velocity, omega, 0.0));
  const auto named = x.outputs(t);
  for (const auto& o : named) {
    INFO(o.name);
    const vec3<> is = o.name == "seen.v"   ? s[seen_v]
                      : o.name == "seen.r" ? s[seen_r]
                      : o.name == "seen.w" ? s[seen_w]
                      : o.name == "seen.a" ? s[seen_a]
                      : o.name == "seen.p" ? s[seen_p]
                                           : vec3<>{s[drive], 0, 0};
    CHECK(o.numbers[0] == within(is.x, 1e-14));
  }
  CHECK(named.size() == 6);
  runtime_chain appended;
  appended << c;
  auto n = appended.make_state();
  n.vector("r") = turn, n.vector("w") = omega, n.vector("al") = alpha, n.input("wanted") = 0.5;
  n.internal("sum").z = 0.02;
  set_positions(n, at), set_velocities(n, v), set_accelerations(n, a);
  appended.doMotion(n);
  const auto again = appended.outputs(n);
  REQUIRE(again.size() == named.size());
  for (std::size_t i = 0; i < named.size(); ++i) {
    CHECK(again[i].name == named[i].name);
    CHECK(again[i].numbers[0] == within(named[i].numbers[0], 1e-14));
  }

  const auto needed = inverse_dynamics(c, s);
  CHECK(needed[0] == within(inverse_dynamics(x, t)[0], 1e-13));
  CHECK(forward_dynamics(c, s)[0] == within(forward_dynamics(x, t)[0], 1e-12));
  CHECK(mass_matrix(c, s)(0, 0) == within(mass_matrix(x, t)(0, 0), 1e-15));

  // derivatives go through the controller
  const auto exact = inverse_dynamics_derivatives(c, s);
  const auto exact_at_run_time = inverse_dynamics_derivatives(x, t, at, v, a);
  const std::array<double, 1> above{0.4 + 1e-5}, below{0.4 - 1e-5};
  const double rise = inverse_dynamics(x, t, above, v, a)[0],
               slope = (rise - inverse_dynamics(x, t, below, v, a)[0]) / 2e-5;
  CHECK(exact.by_q(0, 0) == within(exact_at_run_time.by_q(0, 0), 1e-12));
  CHECK(exact.by_v(0, 0) == within(exact_at_run_time.by_v(0, 0), 1e-12));
  CHECK(exact.by_q(0, 0) == within(slope, 1e-7));

  // an accelerometer at rest
  auto rest = make_state(c);
  c.doMotion(rest);
  CHECK(near(rest[seen_a], vec3<>{-0.3, 0.4, 9.81}, 1e-15));

  manipulator_dynamics_model model(c);
  manipulator_dynamics_model at_run_time(x);
  REQUIRE(model.input().size() == 10);
  Eigen::VectorXd u(10);
  u << 0.4, -1.2, 0.8, 0.5, 0.4, -0.3, -1.1, 2.2, 0.7, 0.5;
  model.setInput(u), at_run_time.setInput(u);
  const Eigen::Vector3d at_x{0.4, -0.3, 0.02};
  const Eigen::Vector3d slopes = model(0.0, at_x);
  CHECK(difference_of(slopes, Eigen::Vector3d(at_run_time(0.0, Eigen::VectorXd(at_x)))) < 1e-13);
  CHECK(slopes[2] == within(0.1, 1e-16));
}

TEST_CASE("a controller whose desired value is measured; a base at a given rate") {
  manipulator_dynamics_model model(followed_disc(key_itself, to_flat));
  manipulator_dynamics_model at_run_time(followed_disc(text_of_key, to_runtime));
  Eigen::Vector2d u{0.5, -0.2};  // rate and acceleration of the cam
  model.setInput(u), at_run_time.setInput(u);
  const auto x = model.make_x(std::array{0.2}, std::array{-0.3}, std::array{0.3, 0.05});  // angle of the cam, integral
  const Eigen::Vector4d slopes = model(0.0, x);
  CHECK(slopes[0] == -0.3);
  CHECK(slopes[2] == 0.5);
  const double error = 0.3 + 0.2 - 0.2, free = 80 * error + 40 * 0.05 + 6 * 0.3;  // the rod stands at 0.3 + 0.2
  REQUIRE(free > 20);
  CHECK(slopes[3] == within(error - 0.0125 * (free - 20), 1e-15));
  CHECK(difference_of(slopes, Eigen::Vector4d(at_run_time(0.0, Eigen::VectorXd(x)))) < 1e-14);
  // Newton and Euler: I q'' about the joint, which stays where it is
  const double inertia = 0.3 + 2 * 0.01, angle = 0.5, pull = 2 * 0.1 * (-0.4 * std::cos(angle) - 0.3 * std::sin(angle));
  CHECK(slopes[1] == within((20 + pull) / inertia + 0.2, 1e-13));

  // the matrix of derivatives, by differences, where the output is not limited
  const auto y = model.make_x(std::array{0.2}, std::array{-0.3}, std::array{0.1, 0.05});
  const Eigen::Matrix4d exact = model.jacobian(0.0, y);
  for (int j = 0; j < 4; ++j) {
    const Eigen::Vector4d d = 1e-5 * Eigen::Vector4d::Unit(j);
    const Eigen::Vector4d by_differences = (model(0.0, y + d) - model(0.0, y - d)) / 2e-5;
    CHECK(difference_of(Eigen::Vector4d(exact.col(j)), by_differences) < 1e-8);
  }
}

TEST_CASE("gains that are invalid") {
  CHECK(complaint([] {
          (void)pid_control_gen("q", "r", "z", "u", {.proportional = 1, .limit = 0});
        }).find("limit must be positive, got 0") != std::string::npos);
  CHECK(complaint([] {
          (void)pid_control_gen("q", "r", "z", "u", {.proportional = not_a_number});
        }).find("proportional must be finite") != std::string::npos);
}

}  // namespace controls_test
