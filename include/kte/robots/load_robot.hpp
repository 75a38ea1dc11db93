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
[[nodiscard]] robot_description describe_robot(std::string_view text, const std::string& name,
                                               const robot_options& options = {});

/// The names of the models in a file, such as an SDF world (robot_options::model); in other formats the name of the
/// robot.
[[nodiscard]] std::vector<std::string> models(const std::filesystem::path& path, const robot_options& options = {});

/// Reads a robot from a file (docs/robots.md): a chain, limits, shapes, and notes on what was not read. Throws
/// `bad_file` with line and element.
[[nodiscard]] robot load_robot(const std::filesystem::path& path, const robot_options& options = {});

#ifdef KTE_FUNCTION
KTE_FUNCTION robot_description describe_robot(std::string_view text, const std::string& name,
                                              const robot_options& options) {
  return detail::read_any(detail::parse_xml(text, name), name, options, detail::parse_xml_file);
}
KTE_FUNCTION std::vector<std::string> models(const std::filesystem::path& path, const robot_options& options) {
  auto root = detail::parse_xml(detail::text_of_file(path), path.string());
  if (root.name == "sdf") return detail::sdf_models(std::move(root), path.string(), options, detail::parse_xml_file);
  return {detail::read_any(std::move(root), path.string(), options, detail::parse_xml_file).name};
}
KTE_FUNCTION robot load_robot(const std::filesystem::path& path, const robot_options& options) {
  const auto text = detail::text_of_file(path);
  return to_robot(describe_robot(text, path.string(), options), options);
}
#endif

}  // namespace kte
