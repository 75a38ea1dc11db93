#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// Adds the motors of a robot to its chain, a `joint_motor_gen` each, with a command as input, and lists them in
/// `robot.motors`, in the order of inputs:
///   MJCF    <actuator> motor, position, velocity, general: gear, gains, ranges of commands and forces
///   URDF    <transmission>; for a file without one, and for SDF, one for each joint that is not a follower
///
/// A command in MJCF is that of its actuator; otherwise it is the force of the joint, after the gear. Forces are
/// limited to the effort of the joint, if there is one. Damping, friction and armature are already in the chain. Motors
/// that are not supported are listed in `warnings`, other contents in `not_read`. An input has the name of its
/// actuator, or `JOINT.motor` if the actuator has no name or a coordinate has the same one.
///
/// Throws `bad_argument` for a robot that already has motors and for invalid options, `bad_parameter` for limits that
/// do not fit the chain; the robot is then unchanged.
void add_motors(robot& r, const motor_options& options = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/motor_maker.hpp>

namespace kte {
KTE_FUNCTION void add_motors(robot& r, const motor_options& options) { detail::motor_maker(r, options).add(); }
}  // namespace kte
#endif
