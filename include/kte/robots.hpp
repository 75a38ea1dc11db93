#pragma once

/// Robots from URDF, MJCF and SDF, to URDF and MJCF, and what is odd about them (needs tinyxml2; docs/robots.md).
#include <kte/robots/check_robot.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>
