#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_parser.hpp>
#include <kte/robots/options.hpp>

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/urdf_robot.hpp>
#endif

namespace kte::detail {

/// Reads a robot from the root of a URDF; `name` names the file in messages.
robot_description read_urdf(const xml_node& root, const std::string& name, const robot_options& options);
robot_description read_urdf(std::string_view text, const std::string& name, const robot_options& options,
                            xml_parser parse);

#ifdef KTE_FUNCTION
KTE_FUNCTION robot_description read_urdf(const xml_node& root, const std::string& name, const robot_options& options) {
  check_options(options);
  robot_description d;
  d.source = name;
  urdf_robot(d, options).read({root, d});
  return d;
}
KTE_FUNCTION robot_description read_urdf(std::string_view text, const std::string& name, const robot_options& options,
                                         xml_parser parse) {
  return read_urdf(parsed(text, name, parse), name, options);
}
#endif

}  // namespace kte::detail
