#pragma once

#include <kte/errors.hpp>
#include <kte/robots/detail/parse_xml.hpp>
#include <kte/robots/detail/read_sdf.hpp>

namespace kte {

/// The description of a robot by a text in SDF; `name` is that of the file in messages. Throws `bad_file` with line and
/// element.
[[nodiscard]] inline robot_description from_sdf(std::string_view text, const std::string& name = "SDF",
                                                const robot_options& options = {}) {
  return detail::read_sdf(text, name, options, detail::parse_xml);
}

/// The description of a robot by a file in SDF. Throws `bad_file` with line and element.
[[nodiscard]] inline robot_description load_sdf(const std::filesystem::path& path, const robot_options& options = {}) {
  return from_sdf(detail::text_of_file(path), path.string(), options);
}

}  // namespace kte
