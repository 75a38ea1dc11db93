#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/robot.hpp>

namespace kte {

/// Adds the motors of a robot to its chain, a `joint_motor_gen` each, with a command for an input, and lists them in
/// `robot.motors`, which is also the order of inputs:
///   MJCF    <actuator> motor, position, velocity, general: gear, gains, ranges of commands and forces
///   URDF    <transmission>; of a file without one, and of SDF, one for each joint that moves by itself
/// In MJCF a command is that of the actuator, else the force of the joint, behind its gear. Forces are kept within the
/// limit of the joint's effort, if there is one. Damping, friction and armature are in the chain already. What cannot
/// be had is in `warnings`, by name, what does not hold motors in `not_read`. An input is called as its actuator, or
/// `JOINT.motor` where that has no name, or a coordinate has it.
///
/// Throws `bad_argument` for a robot that has motors, and for options that make no sense, `bad_parameter` for limits
/// that do not fit the chain; nothing has changed then.
void add_motors(robot& r, const motor_options& options = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/motor_maker.hpp>

namespace kte {
KTE_FUNCTION void add_motors(robot& r, const motor_options& options) { detail::motor_maker(r, options).add(); }
}  // namespace kte
#endif
