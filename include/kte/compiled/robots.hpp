#pragma once

/// Robots from files.
#include <kte/robots/check_robot.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/read_any.hpp>
#include <kte/robots/detail/xml_text.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_writer.hpp>
