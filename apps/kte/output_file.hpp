#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "../kte_header/files_of_robot.hpp"
#include "command_line.hpp"
#include "mechanism.hpp"

namespace kte_tool {

/// A file on the command line: "FILE" or "--start", and its path, empty if it is not given.
struct named_file {
  std::string argument, path;
};

/// Throws `usage_error` if an output is also an input, by whatever path or link: it would be replaced.
inline void refuse_input_as_output(const named_file& output, const std::vector<named_file>& inputs) {
  std::error_code none;
  if (output.path.empty() || !std::filesystem::is_regular_file(output.path, none)) return;
  for (const auto& input : inputs)
    if (!input.path.empty() && std::filesystem::equivalent(output.path, input.path, none))
      throw usage_error("'" + output.path + "' of " + output.argument + " is also the input " + input.argument +
                        (input.path == output.path ? "" : " '" + input.path + "'") + ", which it would replace");
}

/// Likewise for an output that is a file to which that of a robot refers.
inline void refuse_file_of_robot_as_output(const named_file& output, const mechanism& m, const reading& in) {
  if (m.description && !output.path.empty())
    refuse_input_as_output(output, {{"of FILE", file_of_robot_at(output.path, *m.description, robot_options_of(in))}});
}

}  // namespace kte_tool
