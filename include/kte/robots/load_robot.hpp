#pragma once

#include <kte/robots/detail/parse_xml.hpp>
#include <kte/robots/detail/read_any.hpp>
#include <kte/robots/mjcf_reader.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_reader.hpp>

namespace kte {

/// The description of a robot by a text in URDF, MJCF or SDF; the first tag tells the format. Throws `bad_file` with
/// line and element.
[[nodiscard]] inline robot_description describe_robot(std::string_view text, const std::string& name,
                                                      const robot_options& options = {}) {
  return detail::read_any(text, name, options, detail::parse_xml);
}

/// The names of the models in a file, such as an SDF world (robot_options::model); in other formats the name of the
/// robot.
[[nodiscard]] inline std::vector<std::string> models(const std::filesystem::path& path,
                                                     const robot_options& options = {}) {
  return detail::models_of_file(path, options, detail::parse_xml);
}

/// Reads a robot from a file (docs/robots.md): a chain, limits, shapes, and notes on what was not read. Throws
/// `bad_file` with line and element.
[[nodiscard]] inline robot load_robot(const std::filesystem::path& path, const robot_options& options = {}) {
  return detail::robot_of_file(path, options, detail::parse_xml);
}

}  // namespace kte
