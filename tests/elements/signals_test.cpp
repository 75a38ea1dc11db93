#include <kte/dynamics.hpp>
#include <kte/simulation.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

using namespace kte;
using namespace kte::test;

/// Measures and controls.
namespace {
// clang-format off
constexpr struct q_       final : coord_key<"q">           {} q;
constexpr struct lift_    final : coord_key<"lift">        {} lift;
constexpr struct ground_  final : frame_3D_key<"ground">   {} ground;
constexpr struct table_   final : frame_3D_key<"table">    {} table;
constexpr struct arm_     final : frame_3D_key<"arm">      {} arm;
constexpr struct tool_    final : frame_3D_key<"tool">     {} tool;
constexpr struct floor_   final : frame_2D_key<"floor">    {} floor_frame;
constexpr struct cam_     final : frame_2D_key<"cam">      {} cam;
constexpr struct rod_     final : frame_2D_key<"rod">      {} rod;
constexpr struct r_       final : vector_key<"r">          {} r;
constexpr struct w_       final : vector_key<"w">          {} w;
constexpr struct al_      final : vector_key<"al">         {} al;
constexpr struct seen_p_  final : vector_key<"seen.p">     {} seen_p;
constexpr struct seen_v_  final : vector_key<"seen.v">     {} seen_v;
constexpr struct seen_r_  final : vector_key<"seen.r">     {} seen_r;
constexpr struct seen_w_  final : vector_key<"seen.w">     {} seen_w;
constexpr struct seen_a_  final : vector_key<"seen.a">     {} seen_a;
constexpr struct speed_   final : input_key<"speed">       {} speed;
constexpr struct rate_    final : input_key<"rate">        {} rate;
constexpr struct wanted_  final : input_key<"wanted">      {} wanted;
constexpr struct drive_   final : input_key<"drive">       {} drive;
constexpr struct sum_     final : internal_key<"sum">      {} sum;
constexpr struct where_   final : internal_key<"where">    {} where;
constexpr struct nothing_ final : vector_key<"nothing">    {} nothing;
constexpr struct part_e_  final : internal_key<"e">      {} part_e;
constexpr struct part_x_  final : internal_key<"x">      {} part_x;
constexpr struct part_y_  final : internal_key<"y">      {} part_y;
constexpr struct part_z_  final : internal_key<"z">      {} part_z;
// clang-format on

constexpr pid_gains gains{.proportional = 80, .integral = 40, .derivative = 6, .limit = 20, .tracking = 0.0125};
constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};

constexpr auto key_itself = [](const auto& key) { return key; };
constexpr auto text_of_key = [](const auto& key) { return std::string(key.name); };
constexpr auto to_static = [](const auto&... e) { return chain(e...).gravity(vec3{0.3, -0.4, -9.81}); };
constexpr auto to_flat = [](const auto&... e) { return chain(e...).gravity(vec3{0.3, -0.4, zero}); };
constexpr auto to_runtime = [](const auto&... e) {
  kte_map_chain c;
  (c << ... << e);
  return c.gravity(vec3{0.3, -0.4, -9.81});
};

/// An arm on a table that turns, driven by a controller, and all measures on its tool.
template <class Name, class To>
auto measured_arm(const Name& name, const To& to) {
  return to(rotation_control_3D(name(r), name(w), name(al), name(ground), name(table)),
            pid_control_gen(name(q), name(wanted), name(sum), name(drive), gains),
            revolute_joint_3D(name(q), name(table), name(arm), axis::y), inertia_3D(name(arm), body),
            driving_actuator_gen(name(q), name(drive)), rigid_link_3D(name(arm), name(tool), vec3{0.3, -0.1, 0.2}),
            position_measure_3D(name(tool), name(seen_p)), velocity_measure_3D(name(tool), name(seen_v)),
            rotation_measure_3D(name(tool), name(seen_r)), ang_velocity_measure_3D(name(tool), name(seen_w)),
            acceleration_measure_3D(name(tool), name(seen_a)));
}
/// A coordinate at a given rate lifts a disc, whose angle is measured by what another controller wants.
template <class Name, class To>
auto followed_disc(const Name& name, const To& to) {
  return to(ang_velocity_control_2D(name(speed), name(rate), name(where), name(floor_frame), name(cam)),
            revolute_joint_2D(name(q), name(cam), name(rod)),
            inertia_2D(name(rod), planar_body(2.0, 0.3, along_x(0.1))), rotation_measure_2D(name(rod), name(wanted)),
            pid_control_gen(name(q), name(wanted), name(sum), name(drive), gains),
            driving_actuator_gen(name(q), name(drive)));
}
template <class A, class B>
double difference_of(const A& a, const B& b) {
  return (a - b).template lpNorm<Eigen::Infinity>() / std::max(1.0, b.template lpNorm<Eigen::Infinity>());
}
template <class V>
vec3<digits50> derivative_of(V position) {  // by differences: h^2 = 1e-34
  const digits50 h("1e-17");
  return (1 / (2 * h)) * (position(h) - position(digits50(-h)));
}
}  // namespace

TEST_CASE("measures of frames: rates are derivatives of positions, in axes of the world", "[signals]") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto x = trial_of<digits50>(velocity_measure_3D("x", "y"), seed);
    const auto place = [&x](const digits50& t) {
      auto y = x;
      y.move(t);
      return y.at<0>();
    };
    CHECK(near(derivative_of([&](const digits50& t) { return place(t).position; }), x.output(), digits50("1e-30")));

    auto turned = trial_of<digits50>(rotation_measure_3D("x", "y"), seed);
    auto turns = trial_of<digits50>(ang_velocity_measure_3D("x", "y"), seed);
    const auto& u = turned.output();
    const auto R = turned.at<0>().rotation, same = matrix(u);
    CHECK(dot(u, u) <= digits50("9.8696044010893586188344909998761511353136994072408"));
    const auto& w_world = turns.output();
    turns.at<0>() = x.at<0>();
    turns.doMotion();
    const auto column = [&](int i, const auto& m) {
      return i == 0 ? transpose(m).x : i == 1 ? transpose(m).y : transpose(m).z;
    };
    for (int i = 0; i < 3; ++i) {
      CHECK(near(column(i, R), column(i, same), digits50("1e-47")));
      const auto now = column(i, x.at<0>().rotation);
      CHECK(near(derivative_of([&](const digits50& t) { return column(i, place(t).rotation); }), cross(w_world, now),
                 digits50("1e-30")));
    }
  }
  auto flat = trial_of(rotation_measure_2D("x", "y"), 1);
  flat.at<0>().rotation = rotation_by(-2.5);
  flat.doMotion();
  CHECK(flat.output() == within(-2.5, 1e-15));
  auto spin = trial_of(ang_velocity_measure_2D("x", "y"), 1);
  CHECK(spin.output() == spin.at<0>().ang_velocity);
  auto slide = trial_of(velocity_measure_2D("x", "y"), 1);
  const auto& f = slide.at<0>();
  CHECK(slide.output().x == within(f.rotation.cos * f.velocity.x - f.rotation.sin * f.velocity.y, 1e-15));
  CHECK(slide.output().z == 0);
  auto moves = trial_of(velocity_measure_gen("x", "y"), 1);
  CHECK(moves.output() == moves.at<0>().q_dot);
}

TEST_CASE("a frame that turns as signals say: closed form, and power", "[signals]") {
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

  // a base that moves: the same as a joint with a coordinate of the same motion
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

TEST_CASE("an arm on a table that turns, with measures and a controller: static and at run time", "[signals]") {
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

TEST_CASE("no force may depend on an accelerometer", "[signals]") {
  const auto all = [](const auto& name, const auto& to) {
    return to(revolute_joint_3D(name(q), name(ground), name(arm), axis::y), inertia_3D(name(arm), body),
              acceleration_measure_3D(name(arm), name(seen_a)),
              driving_actuator_3D(name(arm), name(seen_a), name(nothing)));
  };
  const auto c = all(key_itself, to_static);
  const auto x = all(text_of_key, to_runtime);
  auto s = make_state(c);
  auto t = x.make_state();
  const auto because = contains_text("acceleration_measure_3D measures an acceleration, on which a force depends");
  CHECK_THROWS_WITH(forward_dynamics(c, s), because);
  CHECK_THROWS_WITH(forward_dynamics(x, t), because);
  CHECK_THROWS_AS(forward_dynamics(x, t), bad_argument);
  c.doMotion(s), c.clearForce(s), c.doForce(s);
  CHECK(inverse_dynamics(c, s)[0] == within(-s[q].f, 1e-14));
  CHECK(inverse_dynamics(x, t)[0] == within(-s[q].f, 1e-14));
}

TEST_CASE("a controller whose wanted signal is measured; a base at a given rate", "[signals]") {
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

TEST_CASE("a coordinate at a given rate is one at a given position", "[signals]") {
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

TEST_CASE("frames at given rates", "[signals]") {
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

TEST_CASE("a top on a frame that turns: static and at run time, and half a turn by integration", "[signals]") {
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

TEST_CASE("gains that make no sense", "[signals]") {
  CHECK(complaint([] {
          (void)pid_control_gen("q", "r", "z", "u", {.proportional = 1, .limit = 0});
        }).find("limit must be positive, got 0") != std::string::npos);
  CHECK(complaint([] {
          (void)pid_control_gen("q", "r", "z", "u", {.proportional = not_a_number});
        }).find("proportional must be finite") != std::string::npos);
}
