#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/xml_parser.hpp>
#include <kte/robots/options.hpp>

namespace kte::detail {

/// Reads a robot from the root of a file in MJCF; `name` names the file in messages and is its path if it refers to
/// other files, which `parse` reads.
robot_description read_mjcf(xml_node root, const std::string& name, const robot_options& options, xml_parser parse);
robot_description read_mjcf(std::string_view text, const std::string& name, const robot_options& options,
                            xml_parser parse);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/mjcf_bodies.hpp>

namespace kte::detail {
KTE_FUNCTION robot_description read_mjcf(xml_node root, const std::string& name, const robot_options& options,
                                         xml_parser parse) {
  check_options(options);
  robot_description d;
  d.source = name;
  mjcf_bodies(d, options, parse).read(std::move(root));
  return d;
}
KTE_FUNCTION robot_description read_mjcf(std::string_view text, const std::string& name, const robot_options& options,
                                         xml_parser parse) {
  return read_mjcf(parsed(text, name, parse), name, options, parse);
}
}  // namespace kte::detail
#endif
