#pragma once

#include <kte/errors.hpp>
#include <kte/robots/detail/parse_xml.hpp>
#include <kte/robots/detail/read_urdf.hpp>

namespace kte {

/// The description of a robot by a text in URDF; `name` is that of the file in messages. Throws `bad_file` with line
/// and element.
[[nodiscard]] inline robot_description from_urdf(std::string_view text, const std::string& name = "URDF",
                                                 const robot_options& options = {}) {
  return detail::read_urdf(text, name, options, detail::parse_xml);
}

/// The description of a robot by a file in URDF. Throws `bad_file` with line and element.
[[nodiscard]] inline robot_description load_urdf(const std::filesystem::path& path, const robot_options& options = {}) {
  return from_urdf(detail::text_of_file(path), path.string(), options);
}

}  // namespace kte
