#pragma once

/// Part of kte/compiled.hpp: robots and models from files, recordings, tables.
#include <kte/compiled/loops.hpp>
#include <kte/compiled/registry.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/io/recording.hpp>
#include <kte/io/table_writer.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/read_any.hpp>
#include <kte/robots/detail/xml_text.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_writer.hpp>
