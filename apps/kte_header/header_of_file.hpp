#pragma once

#include <kte/io/model_content.hpp>
#include <kte/robots/header.hpp>
#include <kte/robots/load_robot.hpp>

#include "files_of_robot.hpp"

/// Of `kte-header` and `kte convert`.
namespace kte_tool {

/// A robot or model of a file as a C++ header, under a name; `bytes` is what is in the file. warn(note) for what is
/// odd. `out`: where it will be written; throws `bad_argument` if that is a file of the robot.
template <class Warn>
std::string header_of_file(std::string_view bytes, const std::filesystem::path& file, const std::string& name,
                           const kte::robot_options& options, const std::filesystem::path& out, const Warn& warn) {
  if (auto model = kte::detail::model_in(bytes, file)) {
    if (options.gravity) model->gravity = {options.gravity->x, options.gravity->y, options.gravity->z};
    return kte::to_header(*model, name);
  }
  const auto description = kte::describe_robot(bytes, file.string(), options);
  if (const auto used = file_of_robot_at(out, description, options); !used.empty())
    throw kte::bad_argument("kte: the header '" + out.string() + "' would replace '" + used + "', a file of the robot");
  const auto robot = kte::to_robot(description, options);
  for (const auto& note : robot.warnings) warn(note);
  return kte::to_header(robot.chain, name, robot.limits);
}

}  // namespace kte_tool
