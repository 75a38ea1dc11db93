#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/solution.hpp>
#include <kte/models/controlled.hpp>
#include <kte/models/runtime_dynamics_model.hpp>
#include <kte/static.hpp>

#include <cmath>

#include "catch.hpp"
#include "chain/registered.hpp"

// A wheel on a ball joint, turned by a motor that brakes it: of both kinds of chain.

namespace controlled_test {

using namespace kte;

// clang-format off
constexpr struct turn_  final : rotation_3D_key<"turn"> {} turn;
constexpr struct q_     final : coord_key<"q">          {} q;
constexpr struct base_  final : frame_3D_key<"base">    {} base;
constexpr struct hub_   final : frame_3D_key<"hub">     {} hub;
constexpr struct wheel_ final : frame_3D_key<"wheel">   {} wheel;
constexpr struct motor_ final : input_key<"motor">      {} motor;
// clang-format on

const rigid_body<> body{1.0, {}, {0.5, 0.0, 0.0, 0.5, 0.0, 0.5}};
const auto gyroscope =
    chain(spherical_joint_3D(turn, base, hub), inertia_3D(hub, body), revolute_joint_3D(q, hub, wheel, axis::z),
          inertia_3D(wheel, body), driving_actuator_gen(q, motor));
constexpr std::array q0{1.0, 0.0, 0.0, 0.0, 0.0};
constexpr std::array v0{0.0, 0.0, 0.0, 2.0};

/// The motor and its reaction on the hub brake the wheel against the hub: d/dt q_dot = -c q_dot (1/I + 1/I).
constexpr double c = 0.25, rate = c * (1 / 0.5 + 1 / 0.5);
const auto brake = [](double, const auto& x) { return std::array{-c * x[8]}; };

TEST_CASE("a controlled model is driven by its law at every evaluation, on the group") {
  const manipulator_dynamics_model model(gyroscope);
  controlled gyro(model, brake);
  static_assert(moves_on_group<decltype(gyro), decltype(gyro)::state>);
  dormand_prince45 solver(std::ref(gyro), 0.0, gyro.make_x(q0, v0), {.absolute = 1e-12, .relative = 1e-12});
  solver.integrate(2);
  CHECK(solver.state()[8] == within_relative(2 * std::exp(-2 * rate), 1e-10));
  CHECK(gyro.input()[0] != 0);

  const manipulator_dynamics_model same_model(models::registered(record_of(gyroscope)));
  controlled runtime(same_model, brake);
  dormand_prince45 same(std::ref(runtime), 0.0, runtime.make_x(q0, v0), {.absolute = 1e-12, .relative = 1e-12});
  same.integrate(2);
  CHECK((same.state() - solver.state()).norm() < 1e-10);
}

TEST_CASE("a controlled model follows its law wherever it is asked") {
  const manipulator_dynamics_model model(gyroscope);
  controlled gyro(model, [](double t, const auto&) { return std::array{t}; });
  const auto x = gyro.make_x(q0, v0);
  const double q_ddot = 0.25 * (1 / 0.5 + 1 / 0.5);  // as in the rate of the brake
  CHECK(gyro(0.25, x)[7] == within_relative(q_ddot, 1e-14));
  CHECK(gyro.computeStateRate(0.5, x)[7] == within_relative(2 * q_ddot, 1e-14));
  CHECK(gyro.state_at(0.25, x)[q].q_ddot == within_relative(q_ddot, 1e-14));
  auto torque = gyro.with_output([](const auto& s) { return s[motor]; });
  CHECK(torque.computeOutput(0.75, x) == 0.75);
}

TEST_CASE("a controlled model is a copy, or shares its model by std::ref; its inputs are those of the law") {
  manipulator_dynamics_model model(gyroscope);
  const auto law = [](double t, const auto&) { return std::array{t}; };
  controlled copied(model, law);
  controlled shared(std::ref(model), law);
  const auto x = copied.make_x(q0, v0);
  model.input(motor) = 7;
  CHECK(copied(0.25, x) == shared(0.25, x));
  CHECK(model.input(motor) == 0.25);
  CHECK(shared.input()[0] == 0.25);
  copied(0.5, x);
  CHECK(model.input(motor) == 0.25);
  CHECK(copied.velocities_of(x) == model.velocities_of(x));
}

/// An integral of the wheel's speed that brakes it, beside a damper: with w = q_dot, c' = w,
///   w' = -r (d w + i c),   r = 1/I + 1/I
constexpr double r = 1 / 0.5 + 1 / 0.5, d = 0.1, i = 0.5;
const auto brake_by_integral = [](double, const auto& x, const auto& z) { return std::array{-d * x[8] - i * z[0]}; };
const auto speed = [](double, const auto& x, const auto&) { return std::array{x[8]}; };
/// c and w after t: the damped oscillator c'' + r d c' + r i c = 0.
std::array<double, 2> integral_and_speed(double t, double c0, double w0) {
  const double decay = r * d / 2, w = std::sqrt(r * i - decay * decay);
  const double b = (w0 + decay * c0) / w, e = std::exp(-decay * t), cs = std::cos(w * t), sn = std::sin(w * t);
  return {e * (c0 * cs + b * sn), e * ((-decay * c0 + w * b) * cs + (-decay * b - w * c0) * sn)};
}

TEST_CASE("a law may have its own states, which integrate with those of the model, on the group") {
  const auto check = [](auto& pid, double epsilon) {
    using state = typename std::remove_reference_t<decltype(pid)>::state;
    static_assert(moves_on_group<std::remove_reference_t<decltype(pid)>, state>);
    const state x0 = pid.make_x(q0, v0);
    CHECK(pid.law_states_of(x0)[0] == 0.25);
    CHECK(pid.internals() == 1);
    CHECK(pid.velocities_of(x0)[3] == 2);
    CHECK(pid.getJointStates(pid.state_at(0, x0)) == x0);  // the law at its start
    using rate_type = typename std::remove_reference_t<decltype(pid)>::rate;
    const auto last = pid.rates() - 1;
    const rate_type step = rate_type::Constant(pid.rates(), 0.1);
    rate_type sizes = step, rest = step;
    state moved = x0;
    pid.magnitudes(x0, sizes), pid.displace(x0, step, moved), pid.rounding(x0, step, moved, rest);
    CHECK(sizes[last] == 0.25);
    CHECK(rest[last] == 0.1 - ((0.25 + 0.1) - 0.25));
    dormand_prince45 solver(std::ref(pid), 0.0, x0, {.absolute = 1e-12, .relative = 1e-12});
    auto sampled = solver;
    solution whole(solver);
    solver.integrate(2, whole);
    sampled.integrate(2, every(0.01), [&](double t, const auto& x) { CHECK((whole(t) - x).norm() < 1e-14); });
    const auto [c, w] = integral_and_speed(2, 0.25, 2);
    CHECK(pid.law_states_of(solver.state())[0] == test::within_relative(c, epsilon));
    CHECK(pid.velocities_of(solver.state())[3] == test::within_relative(w, epsilon));
    CHECK(pid.positions_of(solver.state()).template head<4>().norm() == test::within(1, 1e-14));
    CHECK(pid.input()[0] == test::within_relative(-d * w - i * c, 1e-9));
    CHECK(velocities(pid.state_at(2, solver.state()))[3] == solver.state()[8]);
  };
  const manipulator_dynamics_model model(gyroscope);
  controlled pid(model, brake_by_integral, speed, std::array{0.25});
  check(pid, 1e-10);
  auto torque = pid.with_output([](const auto& s) { return s[motor]; });
  CHECK(torque.computeOutput(0, torque.make_x(q0, v0)) == -d * 2 - i * 0.25);
  manipulator_dynamics_model shared(models::registered(record_of(gyroscope)));
  controlled runtime(std::ref(shared), brake_by_integral, speed, Eigen::Matrix<double, 1, 1>(0.25));
  check(runtime, 1e-10);
  const Eigen::VectorXd few = Eigen::VectorXd::Zero(runtime.state_size() - 1);
  const auto counted = test::says("x has " + std::to_string(few.size()) + " numbers, the chain has " +
                                  std::to_string(runtime.state_size()));
  CHECK_THROWS_MATCHES(runtime.positions_of(few), bad_argument, counted);
  CHECK_THROWS_MATCHES(runtime.velocities_of(few), bad_argument, counted);
  CHECK_THROWS_MATCHES(runtime.internals_of(few), bad_argument, counted);
  CHECK_THROWS_MATCHES(runtime.law_states_of(few), bad_argument, counted);
  CHECK_THROWS_MATCHES(runtime(0, few), bad_argument, counted);
}

TEST_CASE("the rates of a law are as many as it has states") {
  const manipulator_dynamics_model model(gyroscope);
  std::vector<double> rates(1);
  controlled pid(
      model, brake_by_integral, [&](double, const auto&, const auto&) { return rates; },
      std::array{0.0, 0.0, 0.0, 0.0});
  const auto x = pid.make_x(q0, v0);
  CHECK_THROWS_MATCHES(pid(0, x), bad_argument, test::says("the rates of a law are 1 numbers, the law has 4 states"));
  rates.resize(5);
  CHECK_THROWS_MATCHES(pid(0, x), bad_argument, test::says("the rates of a law are 5 numbers, the law has 4 states"));
  rates = {1, 2, 3, 4};
  CHECK(pid(0, x)[11] == 4);
  struct long_rates {  // as an int, their length is 4
    std::size_t size() const { return (std::size_t{1} << 32) + 4; }
    double operator[](std::size_t) const { return 0; }
  };
  controlled overlong(
      model, brake_by_integral, [](double, const auto&, const auto&) { return long_rates{}; },
      std::array{0.0, 0.0, 0.0, 0.0});
  CHECK_THROWS_WITH(overlong(0, x), test::contains_text("are 4294967300 numbers"));
}

TEST_CASE("inputs that are not finite are named") {
  const double nan = std::nan("");
  const auto refused = [&](auto& model, auto&& motor_of) {
    const auto x = model.make_x(q0, v0);
    CHECK_THROWS_MATCHES(model.setInput(std::array{nan}), bad_argument,
                         test::says("an input of 'motor' must be finite, got nan"));
    CHECK(model.input()[0] == 0);
    motor_of() = HUGE_VAL;
    CHECK_THROWS_MATCHES(model(0, x), bad_argument, test::says("is not finite: input 'motor' is inf"));
    motor_of() = 0;
    controlled sick(model, [&](double t, const auto&) { return std::array{t > 0.5 ? nan : 0}; });
    dormand_prince45 solver(std::ref(sick), 0.0, sick.make_x(q0, v0));
    CHECK_THROWS_MATCHES(solver.integrate(1), integration_failure, test::says("input of 'motor' must be finite"));
    CHECK(solver.time() == test::within(0.5, 1e-6));
  };
  manipulator_dynamics_model model(gyroscope);
  refused(model, [&]() -> double& { return model.input(motor); });
  manipulator_dynamics_model runtime(models::registered(record_of(gyroscope)));
  refused(runtime, [&]() -> double& { return runtime.input("motor"); });
}

}  // namespace controlled_test
