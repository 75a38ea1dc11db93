#pragma once

#include <kte/robots/detail/read_mjcf.hpp>
#include <kte/robots/detail/read_sdf.hpp>
#include <kte/robots/detail/read_urdf.hpp>
#include <kte/robots/to_robot.hpp>

namespace kte::detail {

/// Reads a robot from a text, in the format given by its root element; `name` names the file in messages.
robot_description read_any(std::string_view text, const std::string& name, const robot_options& options,
                           xml_parser parse);
/// The names of the models in a file.
std::vector<std::string> models_of_file(const std::filesystem::path& path, const robot_options& options,
                                        xml_parser parse);
/// Reads a robot from a file into a chain.
robot robot_of_file(const std::filesystem::path& path, const robot_options& options, xml_parser parse);

#ifdef KTE_FUNCTION
inline robot_description read_root(xml_node root, const std::string& name, const robot_options& options,
                                   xml_parser parse) {
  const auto only = [&](robot_description d) {
    if (!options.model.empty() && options.model != d.name)
      d.warnings.push_back({0, "robot_options::model '" + excerpt(options.model) +
                                   "' is not used: the file is no SDF, and has one robot, '" + excerpt(d.name) + "'"});
    return d;
  };
  if (root.name == "robot") return only(read_urdf(root, name, options));
  if (root.name == "mujoco") return only(read_mjcf(std::move(root), name, options, parse));
  if (root.name == "sdf") return read_sdf(std::move(root), name, options, parse);
  raise<bad_file>("kte: " + place_text(name, root.line) + "<" + excerpt(root.name) +
                  "> is not the root of a supported robot format: <robot> (URDF), <mujoco> (MJCF) and <sdf> are");
}
KTE_FUNCTION robot_description read_any(std::string_view text, const std::string& name, const robot_options& options,
                                        xml_parser parse) {
  return read_root(parsed(text, name, parse), name, options, parse);
}
KTE_FUNCTION std::vector<std::string> models_of_file(const std::filesystem::path& path, const robot_options& options,
                                                     xml_parser parse) {
  auto root = parsed(text_of_file(path), path.string(), parse);
  if (root.name == "sdf") return sdf_models(std::move(root), path.string(), options, parse);
  return {read_root(std::move(root), path.string(), options, parse).name};
}
KTE_FUNCTION robot robot_of_file(const std::filesystem::path& path, const robot_options& options, xml_parser parse) {
  return to_robot(read_any(text_of_file(path), path.string(), options, parse), options);
}
#endif

}  // namespace kte::detail
