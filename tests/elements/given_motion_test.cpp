#include "elements/signal_chains.hpp"

namespace given_motion_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::signals;

// Frames and coordinates that move as signals say.

TEST_CASE("a frame that turns as signals say: closed form, and power") {
  auto x = trial_of<digits50>(rotation_control_3D("r", "w", "al", "base", "end"), 1);
  const vec3<digits50> n{digits50("0.6"), 0, digits50("0.8")};
  const auto at = [&](const digits50& t) {  // about n by 4 t + t^2, the base at rest
    auto y = x;
    y.at<3>() = {};
    y.at<0>() = (4 * t + t * t) * n, y.at<1>() = (4 + 2 * t) * n, y.at<2>() = digits50(2) * n;
    y.doMotion();
    return y.output();
  };
  for (const char* when : {"0", "1e-8", "0.5", "2"}) {
    const digits50 t(when);
    const auto e = at(t);
    const auto expected = matrix(axis_angle<digits50>{4 * t + t * t, n});
    CHECK(near(e.rotation.x, expected.x, digits50("1e-48")));
    CHECK(near(e.rotation.z, expected.z, digits50("1e-48")));
    CHECK(near(e.ang_velocity, (4 + 2 * t) * n, digits50("1e-48")));
    const auto by_difference = derivative_of([&](const digits50& dt) { return at(t + dt).rotation.x; });
    const auto& R = e.rotation;  // rows: R' = R [w]x
    CHECK(near(by_difference, cross(R.x, e.ang_velocity), digits50("1e-30")));
  }
  CHECK(near(at(0).rotation.x, vec3<digits50>{1, 0, 0}, digits50(0)));

  // typed zeros cost nothing
  CHECK(detail::turn_about_z(zero).sin == zero);
  CHECK(std::is_same_v<decltype(detail::turn_by(zero3{})), no_rotation>);

  // A moving base equals a joint with a coordinate of this motion.
  auto turned = trial_of(rotation_control_3D("r", "w", "al", "base", "end"), 5);
  auto joint = trial_of(revolute_joint_3D("q", "base", "end", axis::z), 5);
  auto& c = joint.at<0>();
  c.q = 0.7, c.q_dot = -1.2, c.q_ddot = 2.5, c.f = 0;
  joint.at<1>() = turned.at<3>();
  turned.at<0>() = {0, 0, 0.7}, turned.at<1>() = {0, 0, -1.2}, turned.at<2>() = {0, 0, 2.5};
  joint.doMotion(), turned.doMotion();
  random_numbers draw(2);
  testing::detail::load_randomly(joint.output(), draw);
  turned.output().force = joint.output().force, turned.output().torque = joint.output().torque;
  CHECK(near(turned.output().acceleration, joint.output().acceleration, rounding<double>));
  CHECK(near(turned.output().ang_acceleration, joint.output().ang_acceleration, rounding<double>));
  CHECK(near(turned.output().rotation.x, joint.output().rotation.x, rounding<double>));
  joint.doForce(), turned.doForce();
  CHECK(load_difference(turned.at<3>(), joint.at<1>()) < rounding<double>);

  auto flat = trial_of(rotation_control_2D("u", "w", "al", "base", "end"), 5);
  auto hinge = trial_of(revolute_joint_2D("q", "base", "end"), 5);
  hinge.at<0>() = c;
  hinge.at<1>() = flat.at<3>();
  flat.at<0>() = 0.7, flat.at<1>() = -1.2, flat.at<2>() = 2.5;
  hinge.doMotion(), flat.doMotion();
  CHECK(flat.output().acceleration.x == within(hinge.output().acceleration.x, rounding<double>));
  CHECK(flat.output().rotation.sin == within(hinge.output().rotation.sin, rounding<double>));
}

TEST_CASE("a coordinate at a given rate is one at a given position") {
  const auto on = [](const auto& name, const auto& to, const auto& control) {
    return to(control, revolute_joint_3D(name(q), name(ground), name(arm), axis::y), inertia_3D(name(arm), body),
              prismatic_joint_3D(name(lift), name(arm), name(tool), axis::x), inertia_3D(name(tool), body));
  };
  constexpr struct at_ final : input_key<"at"> {
  } at;
  const auto c = on(key_itself, to_static, velocity_control_gen(speed, rate, where, lift));
  const auto p = on(key_itself, to_static, position_control_gen(at, speed, rate, lift));
  const auto x = on(text_of_key, to_runtime, velocity_control_gen("speed", "rate", "where", "lift"));
  manipulator_dynamics_model by_rate(c);
  manipulator_dynamics_model by_position(p);
  manipulator_dynamics_model at_run_time(x);
  by_rate.setInput(Eigen::Vector2d(0.4, 0.7)), at_run_time.setInput(Eigen::Vector2d(0.4, 0.7));
  by_position.setInput(Eigen::Vector3d(0.25, 0.4, 0.7));
  const Eigen::Vector3d slopes = by_rate(0.0, by_rate.make_x(std::array{0.3}, std::array{1.1}, std::array{0.25}));
  CHECK(slopes[1] == by_position(0.0, by_position.make_x(std::array{0.3}, std::array{1.1}))[1]);
  CHECK(slopes[2] == 0.4);
  CHECK(difference_of(slopes, Eigen::Vector3d(at_run_time(0.0, Eigen::VectorXd(Eigen::Vector3d(0.3, 1.1, 0.25))))) <
        1e-14);
}

TEST_CASE("frames at given rates") {
  // where their internal states put them they move as if signals had
  auto by_rate = trial_of(velocity_control_3D("v", "a", "x", "y", "z", "base", "end"), 3);
  auto by_position = trial_of(position_control_3D("p", "v", "a", "base", "end"), 4);
  by_position.at<0>() = {by_rate.at<2>().z, by_rate.at<3>().z, by_rate.at<4>().z};
  by_position.at<1>() = by_rate.at<0>(), by_position.at<2>() = by_rate.at<1>();
  by_position.at<3>() = by_rate.at<5>();
  by_position.doMotion(), by_rate.doMotion();
  CHECK(near(by_rate.output().position, by_position.output().position, 0.0));
  CHECK(near(by_rate.output().acceleration, by_position.output().acceleration, 0.0));
  CHECK(by_rate.at<3>().z_dot == by_rate.at<0>().y);
  CHECK(by_rate.at<4>().z_dot == by_rate.at<0>().z);
  random_numbers draw(5);
  testing::detail::load_randomly(by_rate.output(), draw);
  by_position.output().force = by_rate.output().force, by_position.output().torque = by_rate.output().torque;
  by_rate.doForce(), by_position.doForce();
  CHECK(load_difference(by_rate.at<5>(), by_position.at<3>()) == 0);
  auto flat = trial_of(velocity_control_2D("v", "a", "x", "y", "base", "end"), 3);
  flat.at<4>() = {};
  flat.doMotion();
  CHECK(flat.output().position.y == flat.at<3>().z);
  CHECK(flat.output().velocity.y == flat.at<0>().y);
  CHECK(flat.at<3>().z_dot == flat.at<0>().y);

  auto turns = trial_of<digits50>(ang_velocity_control_3D("w", "al", "e", "x", "y", "z", "base", "end"), 6);
  turns.at<6>() = {};
  turns.doMotion();
  const auto R = turns.output().rotation;
  const auto later = [&turns](const digits50& t) {
    auto y = turns;
    y.move(t);
    y.doMotion();
    return y.output().rotation;
  };
  CHECK(
      near(derivative_of([&](const digits50& t) { return later(t).x; }), cross(R.x, turns.at<0>()), digits50("1e-28")));
  CHECK(
      near(derivative_of([&](const digits50& t) { return later(t).z; }), cross(R.z, turns.at<0>()), digits50("1e-28")));
  CHECK(near(turns.output().ang_velocity, turns.at<0>(), digits50(0)));
  const digits50 norm_rate = (1 + turns.at<2>().z) * turns.at<2>().z_dot + turns.at<3>().z * turns.at<3>().z_dot +
                             turns.at<4>().z * turns.at<4>().z_dot + turns.at<5>().z * turns.at<5>().z_dot;
  CHECK(abs(norm_rate) < digits50("1e-48"));
}

TEST_CASE("a top on a frame that turns: static and at run time, and half a turn by integration") {
  const auto all = [](const auto& name, const auto& to) {
    return to(ang_velocity_control_3D(name(w), name(al), name(part_e), name(part_x), name(part_y), name(part_z),
                                      name(ground), name(table)),
              revolute_joint_3D(name(q), name(table), name(arm), axis::y), inertia_3D(name(arm), body));
  };
  manipulator_dynamics_model model(all(key_itself, to_static));
  manipulator_dynamics_model at_run_time(all(text_of_key, to_runtime));
  Eigen::VectorXd u(6);
  u << 0.6, 0.0, 0.8, 0.0, 0.0, 0.0;
  model.setInput(u), at_run_time.setInput(u);
  const auto start = model.make_x(std::array{0.2}, std::array{-0.3}, std::array{0.1, -0.2, 0.3, 0.4});
  CHECK(difference_of(model(0.0, start), Eigen::Matrix<double, 6, 1>(at_run_time(0.0, Eigen::VectorXd(start)))) <
        1e-14);
  dormand_prince45 solver(std::ref(model), 0.0, model.make_x(std::array{0.2}, std::array{-0.3}),
                          {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(3.0);  // by 3 rad about (0.6, 0, 0.8)
  const auto& at_end = solver.state();
  CHECK(at_end[2] == within(std::cos(1.5) - 1, 1e-10));
  CHECK(at_end[3] == within(0.6 * std::sin(1.5), 1e-10));
  CHECK(at_end[4] == within(0, 1e-15));
  CHECK(at_end[5] == within(0.8 * std::sin(1.5), 1e-10));
}

}  // namespace given_motion_test
