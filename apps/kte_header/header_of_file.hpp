#pragma once

#include <kte/io/model_content.hpp>
#include <kte/robots/header.hpp>
#include <kte/robots/load_robot.hpp>

/// Of `kte-header` and `kte convert`.
namespace kte_tool {

/// A robot or model of a file as a C++ header, under a name; `bytes` is what is in the file. warn(note) for what is
/// odd.
template <class Warn>
std::string header_of_file(std::string_view bytes, const std::filesystem::path& file, const std::string& name,
                           const kte::robot_options& options, const Warn& warn) {
  if (auto model = kte::detail::model_in(bytes, file)) {
    if (options.gravity) model->gravity = {options.gravity->x, options.gravity->y, options.gravity->z};
    return kte::to_header(*model, name);
  }
  const auto robot = kte::to_robot(kte::describe_robot(bytes, file.string(), options), options);
  for (const auto& note : robot.warnings) warn(note);
  return kte::to_header(robot.chain, name, robot.limits);
}

}  // namespace kte_tool
