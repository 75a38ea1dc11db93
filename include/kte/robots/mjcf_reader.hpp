#pragma once

#include <kte/errors.hpp>
#include <kte/robots/detail/parse_xml.hpp>
#include <kte/robots/detail/read_mjcf.hpp>

namespace kte {

/// The description of a robot by a text in MJCF, the format of MuJoCo; `name` is that of the file in messages. Throws
/// `bad_file` with line and element.
[[nodiscard]] inline robot_description from_mjcf(std::string_view text, const std::string& name = "MJCF",
                                                 const robot_options& options = {}) {
  return detail::read_mjcf(text, name, options, detail::parse_xml);
}

/// The description of a robot by a file in MJCF. Throws `bad_file` with line and element.
[[nodiscard]] inline robot_description load_mjcf(const std::filesystem::path& path, const robot_options& options = {}) {
  return from_mjcf(detail::text_of_file(path), path.string(), options);
}

}  // namespace kte
