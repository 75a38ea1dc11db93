#include <kte/dynamics.hpp>
#include <kte/simulation.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace actuators_test {

using namespace kte;
using namespace kte::test;

// clang-format off
constexpr struct q_      final : coord_key<"q">         {} q;
constexpr struct lift_   final : coord_key<"lift">      {} lift;
constexpr struct base_   final : frame_3D_key<"base">   {} base;
constexpr struct arm_    final : frame_3D_key<"arm">    {} arm;
constexpr struct tool_   final : frame_3D_key<"tool">   {} tool;
constexpr struct push_   final : vector_key<"push">     {} push;
constexpr struct twist_  final : vector_key<"twist">    {} twist;
constexpr struct volts_  final : input_key<"volts">     {} volts;
constexpr struct amps_   final : internal_key<"amps">   {} amps;
// clang-format on

constexpr dc_motor_parameters motor{.resistance = 0.6, .inductance = 0.02, .torque_constant = 0.05, .ratio = 4};
constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};

template <class Drive>
auto arm_with(const Drive& drive) {
  return chain(revolute_joint_3D(q, base, arm, axis::y), inertia_3D(arm, body),
               prismatic_joint_3D(lift, arm, tool, vec3{0.6, 0.0, 0.8}), inertia_3D(tool, body), drive)
      .gravity(vec3{0.3, -0.4, -9.81});
}
template <class... E>
runtime_chain named(const E&... e) {
  runtime_chain c;
  return (c << ... << e);
}
template <class A, class B>
double difference_of(const A& a, const B& b) {
  return (a - b).template lpNorm<Eigen::Infinity>();
}

TEST_CASE("actuators of frames: loads by signals are those of the same numbers as parameters") {
  const vec3<> f{0.3, -0.7, 1.1}, t{-0.2, 0.4, 0.9};
  const auto loads = [&](const auto& by_signals, const auto& by_numbers, const auto& torque) {
    auto x = trial_of(by_signals, 7);
    auto y = trial_of(by_numbers, 7);
    y.template at<0>() = x.template at<0>();
    x.template at<1>() = f, x.template at<2>() = torque;
    x.doForce(), y.doForce();
    return load_difference(x.template at<0>(), y.template at<0>());
  };
  CHECK(loads(driving_actuator_3D("x", "f", "t"), follower_force_3D("x", f, t), t) == 0);
  CHECK(loads(external_force_3D("x", "f", "t"), constant_force_3D("x", f, t), t) == 0);
  CHECK(loads(driving_actuator_2D("x", "f", "t"), follower_force_2D("x", vec2{f.x, f.y}, t.z), t.z) == 0);
  CHECK(loads(external_force_2D("x", "f", "t"), constant_force_2D("x", vec2{f.x, f.y}, t.z), t.z) == 0);
}

TEST_CASE("an actuator between two things acts and reacts, and works by its way") {
  random_numbers draw(11);
  CHECK(testing::loads_are_opposite<double>(force_actuator_gen("a", "b", "u"), draw) == 0);
  CHECK(testing::loads_are_opposite<double>(force_actuator_2D("a", "b", "u"), draw) < rounding<double>);
  CHECK(testing::loads_are_opposite<digits50>(force_actuator_3D("a", "b", "u"), draw) < rounding<digits50>);
  const auto work = [](const auto& a, const auto& b, const auto& u) {
    const auto d = b.position - a.position;
    using std::sqrt;
    return std::remove_cvref_t<decltype(u)>(-u * sqrt(dot(d, d)));
  };
  // at 50 digits, where near anchors, whose distance has large derivatives, do not matter
  CHECK(testing::force_is_gradient<digits50>(force_actuator_3D("a", "b", "u"), draw, work) < digits50("1e-28"));
  CHECK(testing::force_is_gradient<digits50>(force_actuator_2D("a", "b", "u"), draw, work) < digits50("1e-28"));
  auto x = trial_of(force_actuator_gen("a", "b", "u"), 1);
  x.at<2>() = 1.5;
  x.doForce();
  CHECK(x.at<1>().f == 1.5);
  auto together = trial_of(force_actuator_3D("a", "b", "u"), 2);
  together.at<1>().position = together.at<0>().position;
  together.doForce();
  CHECK(load_difference(together.at<0>(), frame_3D<>{}) == 0);
}

TEST_CASE("a direct-current motor: power, and its motion under a step of voltage") {
  const auto c = chain(dc_motor_gen(q, volts, amps, motor), revolute_joint_3D(q, base, arm, axis::z),
                       inertia_3D(arm, rigid_body{0.0, vec3{0.0, 0.0, 0.0}, sym3{0.03, 0.0, 0.0, 0.03, 0.0, 0.05}}));
  manipulator_dynamics_model model(c);
  model.input(volts) = 6;
  // J w' = r k i, L i' = u - R i - k r w: eigenvalues s1, s2 of [[0, r k/J], [-r k/L, -R/L]], about the end (u/(r k),
  // 0)
  const double k = 4 * 0.05, J = 0.05, L = 0.02, R = 0.6, w_end = 6 / k;
  const double root = std::sqrt(R * R / (4 * L * L) - k * k / (J * L)), s1 = -R / (2 * L) + root,
               s2 = -R / (2 * L) - root;
  dormand_prince45 solver(std::ref(model), 0.0, model.make_x(std::array{0.0}, std::array{0.0}, std::array{0.0}),
                          {.absolute = 1e-12, .relative = 1e-12});
  for (const double t : {0.01, 0.1, 0.4}) {
    solver.integrate(t);
    const auto& x = solver.state();
    // w(0) = 0, w'(0) = 0
    const double w = w_end * (1 + (s2 * std::exp(s1 * t) - s1 * std::exp(s2 * t)) / (s1 - s2));
    CHECK(x[1] == within(w, 1e-9 * w_end));
    const double i = x[2], i_dot = model(t, x)[2], a = model(t, x)[1];
    CHECK(6 * i == within(R * i * i + L * i * i_dot + J * a * x[1], 1e-13 * std::abs(6 * i)));
  }
  const auto r = named(dc_motor_gen("q", "volts", "amps", motor), revolute_joint_3D("q", "base", "arm", axis::z),
                       inertia_3D("arm", body));
  manipulator_dynamics_model at_run_time(r);
  at_run_time.input("volts") = 6;
  const Eigen::Vector3d x{0.1, 2.0, 3.0};
  CHECK(at_run_time(0.0, Eigen::VectorXd(x))[2] == within((6 - 1.8 - 0.4) / 0.02, 1e-12));
  CHECK(complaint([] {
          (void)dc_motor_gen("q", "u", "i", {.resistance = 1, .inductance = 0, .torque_constant = 1});
        }).find("inductance must be finite and positive, got 0") != std::string::npos);
}

TEST_CASE("a motor within its torque-speed line") {
  const auto e = torque_speed_motor_gen("q", "u", {.max_torque = 40, .max_speed = 8});
  const auto force = [&e](double rate, double command) {
    auto x = trial_of(e, 1);
    x.at<0>().f = 0, x.at<0>().q_dot = rate, x.at<1>() = command;
    x.doForce();
    return x.at<0>().f;
  };
  CHECK(force(0, 100) == 40);
  CHECK(force(0, -100) == -40);
  CHECK(force(2, 100) == 30);
  CHECK(force(2, 29) == 29);
  CHECK(force(2, -100) == -40);  // brakes
  CHECK(force(-2, -100) == -30);
  CHECK(force(-2, 100) == 40);
  CHECK(force(9, 100) == 0);
  CHECK(force(9, -5) == -5);
  CHECK(std::isnan(force(1, not_a_number)));
  const auto c = e.core;
  const auto at = [&c](double rate, double command) {
    return c.switching(coordinate{0.0, rate, 0.0, skip{}, skip{}}, command);
  };
  CHECK(at(2, 29) == 1);
  CHECK(at(2, 31) == -1);
  CHECK(at(2, -39) == 1);
  CHECK(nth<0>(c.doForce(coordinate{zero, zero, zero, skip{}, skip{}}, zero)) == 0);
  CHECK(complaint([] {
          (void)torque_speed_motor_gen("q", "u", {.max_torque = 1, .max_speed = 0});
        }).find("max_speed must be finite and positive, got 0") != std::string::npos);
}

TEST_CASE("where the torque-speed line begins to limit a motor is an event") {
  const auto c = chain(torque_speed_motor_gen(lift, volts, {.max_torque = 40, .max_speed = 8}),
                       prismatic_joint_3D(lift, base, tool, axis::x), inertia_3D(tool, point_mass(2.0)));
  manipulator_dynamics_model model(c);
  model.input(volts) = 30;
  dormand_prince45 solver(std::ref(model), 0.0, model.make_x(std::array{0.0}, std::array{0.0}),
                          {.absolute = 1e-12, .relative = 1e-12});
  const auto report = integrate(solver, 0.4, element_events(model));
  REQUIRE(report.events.size() == 1);
  CHECK(report.events[0].time == within(2 / 15.0, 1e-10));  // at 2 m/s
  CHECK(solver.state()[1] == within(8 - 6 * std::exp(-2.5 * (0.4 - 2 / 15.0)), 1e-10));
}

TEST_CASE("loads from outside are those of actuators on frames") {
  const auto c = arm_with(driving_actuator_3D(tool, push, twist));
  const auto r = named(revolute_joint_3D("q", "base", "arm", axis::y), inertia_3D("arm", body),
                       prismatic_joint_3D("lift", "arm", "tool", vec3{0.6, 0.0, 0.8}), inertia_3D("tool", body))
                     .gravity(vec3{0.3, -0.4, -9.81});
  auto s = make_state(c);
  auto t = r.make_state();
  const vec3<> f{0.3, -0.7, 1.1}, m{-0.2, 0.4, 0.9};
  const Eigen::Vector2d qs{0.4, 0.2}, v{1.1, -0.6}, a{0.7, 0.3}, tau{-0.5, 2.0};
  s[push] = f, s[twist] = m;
  set_positions(s, qs), set_velocities(s, v), set_accelerations(s, a);
  const Eigen::Vector2d needed = inverse_dynamics(c, s), moves = forward_dynamics(c, s);

  CHECK(difference_of(inverse_dynamics(c, qs, v, a, wrench_on(tool, f, m)), needed) < 1e-14);
  CHECK(difference_of(inverse_dynamics(r, t, qs, v, a, {{"tool", f, m}}), needed) < 1e-14);
  CHECK(difference_of(inverse_dynamics(c, qs, v, a), needed) > 0.1);
  const Eigen::Vector2d none{0, 0};
  CHECK(difference_of(forward_dynamics(c, qs, v, none, wrench_on(tool, f, m)), moves) < 1e-13);
  CHECK(difference_of(forward_dynamics(r, t, qs, v, none, {{"tool", f, m}}), moves) < 1e-13);
  // two of them, and tau
  const Eigen::Vector2d both = forward_dynamics(c, qs, v, tau, wrench_on(tool, f), wrench_on(arm, f, m));
  CHECK(difference_of(inverse_dynamics(c, qs, v, both, wrench_on(tool, f), wrench_on(arm, f, m)), tau) < 1e-13);
  CHECK(difference_of(forward_dynamics(r, t, qs, v, tau, {{"tool", f}, {"arm", f, m}}), both) < 1e-13);

  CHECK_THROWS_AS(inverse_dynamics(r, t, qs, v, a, {{"nobody", f, m}}), unknown_name);
  CHECK_THROWS_AS(inverse_dynamics(r, t, qs, v, a, {{"tool", {not_a_number, 0, 0}}}), bad_argument);
  const auto dry = named(dry_revolute_joint_3D("q", "base", "arm", axis::y, 0.02, 0.1), inertia_3D("arm", body));
  auto u = dry.make_state();
  const std::array<double, 1> one_number{0.1};
  CHECK_THROWS_AS(inverse_dynamics(dry, u, one_number, one_number, one_number, {{"arm", f, m}}), bad_argument);
}

TEST_CASE("a motor of a joint follows its law within its ranges") {
  constexpr motor_law servo{.gain = 8,
                            .offset = 0.5,
                            .stiffness = 8,
                            .damping = 2,
                            .lower = -5,
                            .upper = 3,
                            .lower_command = -1,
                            .upper_command = 1};
  const auto force = [](const motor_law& law, double at, double rate, double command) {
    auto x = trial_of(joint_motor_gen("q", "u", law), 1);
    x.at<0>() = {.q = at, .q_dot = rate}, x.at<1>() = command;
    x.doForce();
    return x.at<0>().f;
  };
  CHECK(force({}, 1, 1, 2.5) == 2.5);
  CHECK(force(servo, 0.25, 0.5, 0.25) == -0.5);
  CHECK(force(servo, 1, 0.5, 7) == -0.5);  // as of a command of 1
  CHECK(force(servo, 0, 0, 1) == 3);
  CHECK(force(servo, 2, 0, 1) == -5);
  CHECK(std::isnan(force(servo, not_a_number, 0, 0)));
  CHECK(std::isnan(force(servo, 0, 0, not_a_number)));

  const auto c = chain(inertia_gen(q, 1.0), joint_motor_gen(q, volts, servo));
  auto s = make_state(c);
  s[q] = {.q = 0.25, .q_dot = 0.5}, s[volts] = 0.25;
  const auto d = inverse_dynamics_derivatives(c, s);
  CHECK((d.by_q(0, 0) == 8 && d.by_v(0, 0) == 2));
  CHECK(core::joint_motor_gen{servo}.switching(s[q], 0.25) == 3.5);  // from -0.5
  CHECK(core::joint_motor_gen{}.switching(s[q], 0.25) == 1);

  const std::string where = "kte: joint_motor_gen (coordinate 'q', command 'u'): ";
  const auto what = [](const motor_law& law) { return complaint([&] { (void)joint_motor_gen("q", "u", law); }); };
  CHECK(what({.gain = not_a_number}) == where + "gain must be finite, got nan");
  CHECK(what({.lower = 1, .upper = -1}) == where + "lower must not be above upper, got 1");
  CHECK(what({.lower_command = 1, .upper_command = -1}) ==
        where + "lower_command must not be above upper_command, got 1");
}

}  // namespace actuators_test
