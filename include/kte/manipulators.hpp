#pragma once

#include <kte/detail/macros_aside.hpp>

/// Arms with tools and limits: inverse kinematics in closed form and by iteration, rates within limits, motions.
/// Ready-made arms are in further headers: kte/manipulators/iiwa14.hpp, panda.hpp, ur.hpp ...
#include <kte/manipulators/accelerations_towards.hpp>
#include <kte/manipulators/inverse_kinematics.hpp>
#include <kte/manipulators/joint_motion.hpp>
#include <kte/manipulators/nearest.hpp>
#include <kte/manipulators/numerical_inverse_kinematics.hpp>
#include <kte/manipulators/posture_goals.hpp>
#include <kte/manipulators/rates_towards.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>
#include <kte/manipulators/straight_line.hpp>
#include <kte/manipulators/tool_goals.hpp>

#include <kte/detail/macros_back.hpp>
