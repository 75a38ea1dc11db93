#include "models/held_block.hpp"

namespace modes_at_start_test {

using namespace kte;
using namespace kte::test::held_block;

// Modes that are not what happens when an integration begins, and what is no mode.

TEST_CASE("what is held lets go where an input changes between two calls of integrate") {
  runtime_chain r;
  r << prismatic_joint_2D("x", "ground", "block", axis::x) << inertia_2D("block", point_mass(1.0))
    << joint_stiction_gen("x", "mode", {0.5, 0.5}) << brake_gen("x", "mode 2", "grip")
    << driving_actuator_gen("x", "pull");
  manipulator_dynamics_model at_run_time(r);
  const auto check = [](auto& model, auto&& grip, auto&& pull) {
    grip() = 0.5, pull() = 0.5;
    dormand_prince45 solver(std::cref(model), 0.0, settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0})));
    CHECK(solver.integrate(1.0, element_events(model)).count == 0);
    pull() = 3.0;
    std::vector<double> modes;
    const auto keep = [&](double, const auto& s) { modes.push_back(s[2]); };
    const auto report = solver.integrate(2.0, element_events(model), every(1.0).with_event_rows(), keep);
    REQUIRE(report.events.size() == 1);
    CHECK(report.events[0].time == within(1, 0));
    CHECK(report.events[0].name.starts_with("joint_stiction_gen"));
    CHECK(report.events[0].before[2] == within(mode::held, 0));
    CHECK(modes == std::vector<double>{mode::held, mode::forward, mode::forward});
    CHECK(solver.state()[0] == within(1, 1e-15));  // 2 N are left
    CHECK(solver.state()[1] == within(2, 1e-15));
    pull() = 1.0;  // as much as holds: nothing happens, nor at a call without way
    CHECK(solver.integrate(2.0, element_events(model)).count == 0);
    CHECK(solver.integrate(3.0, element_events(model)).count == 0);
    CHECK(solver.state()[1] == within(2, 1e-15));
    // held, and what is at its limit stays so; then the brake is let go
    solver.restart(0.0, settled(model, 0.0, model.make_x(std::array{0.0}, std::array{0.0})));
    CHECK(solver.integrate(1.0, element_events(model)).count == 0);
    CHECK(solver.state()[1] == within(0, 0));
    grip() = 0.0;
    CHECK(solver.integrate(2.0, element_events(model)).count == 1);
    CHECK(solver.state()[1] == within(0.5, 1e-15));
    // a mode that the rate contradicts
    auto back = solver.state();
    back[1] = -1;
    solver.restart(2.0, back), pull() = 0.0;
    CHECK(solver.integrate(3.0, element_events(model)).events[0].after[2] == within(mode::backward, 0));
    CHECK(solver.state()[1] == within(-0.5, 1e-15));
  };
  check(
      at_run_time, [&]() -> double& { return at_run_time.input("grip"); },
      [&]() -> double& { return at_run_time.input("pull"); });
  const auto c =
      chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)),
            joint_stiction_gen(x, rest, {0.5, 0.5}), brake_gen(x, second, grip), driving_actuator_gen(x, pull));
  manipulator_dynamics_model fixed(c);
  check(
      fixed, [&]() -> double& { return fixed.input(grip); }, [&]() -> double& { return fixed.input(pull); });
}

TEST_CASE("teeth that were pressed let go where their partner jumps between two calls of integrate") {
  runtime_chain r;
  r << position_control_gen("way", "speed", "none", "hand") << inertia_gen("x", 1.0)
    << joint_backlash_mode_gen("hand", "x", "teeth", 0.2, 100.0, 0.0);
  manipulator_dynamics_model model(r);
  model.input("way") = model.input("speed") = model.input("none") = 0.0;
  Eigen::VectorXd start = model.make_x(std::array{0.11}, std::array{0.0});
  start[2] = 1;  // pressed by 1 N
  dormand_prince45 solver(std::cref(model), 0.0, start);
  model.input("way") = 0.05;  // now 0.04 m apart
  const auto report = solver.integrate(1.0, element_events(model));
  REQUIRE(report.events.size() == 1);
  CHECK(report.events[0].after[2] == within(0, 0));
  CHECK(solver.state()[0] == within(0.11, 0));
}

TEST_CASE("a brake that is pulled apart is open, and a mode that is none counts by its sign") {
  runtime_chain c;
  c << inertia_gen("x", 1.0) << joint_stiction_gen("x", "mode", {3.0, 3.0}) << brake_gen("y", "mode 2", "grip")
    << inertia_gen("y", 1.0);
  manipulator_dynamics_model model(c);
  const auto rate = [&](double v, double z, double z2, double u) {
    model.input("grip") = u;
    return Eigen::Vector2d(
        model(0.0, model.make_x(std::array{0.0, 0.0}, std::array{v, v}, std::array{z, z2})).segment(2, 2));
  };
  CHECK(rate(1, 1, 1, 2) == Eigen::Vector2d(-3, -2));
  CHECK(rate(1, 7, 1.5, 2) == Eigen::Vector2d(-3, -2));
  CHECK(rate(-1, -0.5, -7, 2) == Eigen::Vector2d(3, 2));
  CHECK(rate(1, 0, 0, -5) == Eigen::Vector2d(-3, 0));
  CHECK_THROWS_AS(rate(1, std::nan(""), 1, 2), bad_argument);
  CHECK_THROWS_AS(rate(1, 1, 1, std::nan("")), bad_argument);
  // nor does it hold what is at rest
  model.input("grip") = -5;
  const auto x = settled(model, 0.0, model.make_x(std::array{0.0, 0.0}, std::array{0.0, 0.0}));
  CHECK(model.capacity(0.0, x, model.locks()[1].element) == 0);
}

TEST_CASE("what holds a coordinate that another moves is named when the model is made") {
  runtime_chain c;
  c << inertia_gen("x", 1.0) << mimic_gen("x", "y", 2.0) << joint_stiction_gen("y", "mode", {1.0, 1.0});
  const std::string text = "joint_stiction_gen (coordinate 'y', mode 'mode') holds a coordinate that is not a degree";
  CHECK_THROWS_MATCHES(manipulator_dynamics_model(c), bad_wiring, test::says(text));
  auto s = c.make_state();
  CHECK_THROWS_MATCHES(mass_matrix(c, s, std::array{0.0}), bad_argument, test::says(text));
}

TEST_CASE("parameters of friction that holds") {
  const auto says = [](const stiction_parameters& p) -> std::string {
    try {
      (void)joint_stiction_gen("x", "mode", p);
    } catch (const bad_parameter& e) {
      return e.what();
    }
    return "";
  };
  CHECK(says({1.0, 1.0, 0.0, 0.0}) == "");
  CHECK(says({3.0, 2.0}).find("stiction must be finite and not below coulomb, got 2") != std::string::npos);
  CHECK(says({-1.0, 2.0}).find("coulomb must be finite and not negative, got -1") != std::string::npos);
  CHECK(says({1.0, 2.0, -1.0}).find("stribeck_velocity must be finite and not negative, got -1") != std::string::npos);
  CHECK(says({1.0, 2.0, 1.0, -1.0}).find("viscous must be finite and not negative, got -1") != std::string::npos);
}

}  // namespace modes_at_start_test
