#include "live/motor_command.hpp"

#include <kte/elements/joint_motor.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"

namespace motor_command_test {

using namespace kte_tool;

constexpr double none = kte::motor_law::none;
constexpr motor_command::joint turning{true, -2, 3, 5}, free_slide{false, -none, none, none};

TEST_CASE("a command of a motor is a force by its gain, between the ends of its range") {
  const motor_command geared({.gain = 40, .lower_command = -1, .upper_command = 1}, turning);
  CHECK(geared.unit() == "\u00D7 40 N m");
  CHECK(geared.lower() == -1);
  CHECK(geared.upper() == 1);
  CHECK(geared.at_start(0.5, 0.25) == 0.25);
  CHECK(geared.at_start(0.5, 7) == 1);

  const motor_command reversed({.gain = -2, .lower = -6, .upper = 8}, free_slide);
  CHECK(reversed.unit() == "\u00D7 -2 N");
  CHECK(reversed.lower() == -4);
  CHECK(reversed.upper() == 3);

  const motor_command unlimited({}, turning);
  CHECK(unlimited.unit() == "N m");
  CHECK(unlimited.lower() == -10);
  CHECK(unlimited.upper() == 10);
}

TEST_CASE("a command of a servo is a position, and begins where the joint stands") {
  const motor_command servo({.gain = 60, .stiffness = 60, .damping = 3}, turning);
  CHECK(servo.unit() == "rad");
  CHECK(servo.lower() == -2);
  CHECK(servo.upper() == 3);
  CHECK(servo.at_start(0.5, 0) == 0.5);
  CHECK(servo.at_start(9, 0) == 3);

  // By a gear g the command is g q: a = k_file g, k = k_file g^2.
  const motor_command geared({.gain = 60 * 4, .stiffness = 60 * 16}, turning);
  CHECK(geared.unit() == "\u00D7 0.25 rad");
  CHECK(geared.lower() == -8);
  CHECK(geared.upper() == 12);
  CHECK(geared.at_start(0.5, 0) == 2);

  const motor_command one_sided({.gain = 1, .stiffness = 1, .lower_command = 0.5}, free_slide);
  CHECK(one_sided.unit() == "m");
  CHECK(one_sided.lower() == 0.5);
  CHECK(one_sided.upper() == 1);
}

TEST_CASE("a command of a servo of rates is a rate") {
  const motor_command speed({.gain = 20, .damping = 20}, turning);
  CHECK(speed.unit() == "rad/s");
  CHECK(speed.lower() == -5);
  CHECK(speed.upper() == 5);
  CHECK(speed.at_start(0.5, 0) == 0);
}

TEST_CASE("ranges of commands that leave nothing, and commands that do nothing, still have a slider") {
  const motor_command nothing({.gain = 0}, turning);
  CHECK(nothing.unit() == "1");
  CHECK(nothing.lower() < nothing.upper());
  for (const double at : {0.0, 50.0}) {
    const motor_command fixed({.lower_command = at, .upper_command = at}, turning);
    CHECK(fixed.lower() == at);
    CHECK(fixed.upper() > at);
  }
  const motor_command below({.upper_command = -40}, turning);
  CHECK(below.lower() < below.upper());
  CHECK(below.upper() == -40);
  const motor_command tiny({.gain = 1e-320}, turning);
  CHECK(std::isfinite(tiny.lower()));
  CHECK(std::isfinite(tiny.upper()));
}

TEST_CASE("the motor of an input is found in the chain") {
  kte::runtime_chain arm;
  arm << kte::revolute_joint_3D("q", "base", "end", kte::axis::z)
      << kte::joint_motor_gen("q", "torque", {.gain = 3, .upper = 4});
  const auto motor = motor_of_input(arm, "torque");
  REQUIRE(motor);
  CHECK(motor->coordinate == "q");
  CHECK(motor->law == kte::motor_law{.gain = 3, .upper = 4});
  CHECK(!motor_of_input(arm, "q"));
}

}  // namespace motor_command_test
