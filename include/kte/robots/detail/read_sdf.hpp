#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_parser.hpp>
#include <kte/robots/options.hpp>

namespace kte::detail {

/// Reads a robot from the root of a file in SDF; `name` names the file in messages and is its path if it refers to
/// other files, which `parse` reads.
robot_description read_sdf(xml_node root, const std::string& name, const robot_options& options, xml_parser parse);
robot_description read_sdf(std::string_view text, const std::string& name, const robot_options& options,
                           xml_parser parse);
/// The names of the models in such a file.
std::vector<std::string> sdf_models(xml_node root, const std::string& name, const robot_options& options,
                                    xml_parser parse);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/read_urdf.hpp>
#  include <kte/robots/detail/sdf_choice.hpp>
#  include <kte/robots/detail/sdf_model.hpp>
#  include <kte/robots/detail/sdf_world.hpp>

namespace kte::detail {
KTE_FUNCTION robot_description read_sdf(xml_node root, const std::string& name, const robot_options& options,
                                        xml_parser parse) {
  check_options(options);
  robot_description d;
  d.source = name;
  sdf_upgrade(d).apply(root);
  xml_item(root, d).only({"model", "world", "include"}, {"version"});
  const sdf_choice choice(d, options, parse, root);
  const auto& chosen = choice.choose();
  const xml_item model(*chosen.model, d);
  if (model.name() == "robot") {
    auto robot = read_urdf(*chosen.model, name, options);
    if (chosen.world != nullptr) read_sdf_world(d, {*chosen.world, d}, chosen.name);
    if (!is_nothing(sdf_pose(model, options)))
      model.moves_differently("its pose in the world is not read: it is a URDF");
    robot.gravity = d.gravity;
    robot.warnings.insert(robot.warnings.end(), d.warnings.begin(), d.warnings.end());
    robot.not_read.insert(robot.not_read.end(), d.not_read.begin(), d.not_read.end());
    return robot;
  }
  const bool windy = chosen.world != nullptr && read_sdf_world(d, {*chosen.world, d}, model.text_or("name", ""));
  sdf_model(d, options).read(model, windy);
  return d;
}
KTE_FUNCTION robot_description read_sdf(std::string_view text, const std::string& name, const robot_options& options,
                                        xml_parser parse) {
  return read_sdf(parsed(text, name, parse), name, options, parse);
}
KTE_FUNCTION std::vector<std::string> sdf_models(xml_node root, const std::string& name, const robot_options& options,
                                                 xml_parser parse) {
  robot_description d;
  d.source = name;
  sdf_upgrade(d).apply(root);
  return sdf_choice(d, options, parse, root).names();
}
}  // namespace kte::detail
#endif
