#pragma once

#include <kte/detail/macros_aside.hpp>

/// Robots from URDF, MJCF and SDF, to URDF and MJCF, and checks of them (needs tinyxml2; docs/robots.md), with the most
/// common algorithms.
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>

#include <kte/detail/macros_back.hpp>
