#pragma once

#include <array>
#include <string>
#include <string_view>

namespace kte_tool {

/// A message of the library, which calls options by their names in C++, with the names that the program has for them.
inline std::string with_option_names(std::string_view message) {
  struct replacement {
    std::string_view from, to;
  };
  static constexpr std::array all{
      replacement{"robot_options::quarter_turn_tolerance", "--quarter-turns"},
      replacement{"robot_options::contacts", "--ground"},
      replacement{"robot_options::floating_base", "--floating-base"},
      replacement{"robot_options::model = ", "--model "},
      replacement{"robot_options::model", "--model"},
      replacement{"robot_options::search_path", "--search"},
      replacement{"robot_options::world and base_coordinate of a floating base need other names",
                  "--floating-base needs this name, so it must have another one in the file"},
      replacement{"robot_writing::lossy", "--lossy"},
      replacement{" (motor_options::stop_stiffness)", ""},
      replacement{", or positions by those of kte::motor_options", ""},
      replacement{"by kte::add_motors alone", "by motors alone, as of kte live and kte simulate --motors"},
      replacement{" (read_options::max_bytes)", ""},
      replacement{" (read_options::max_items)", ""},
      replacement{" (or give a table_format)", ""},
      replacement{"kte::numerical_inverse_kinematics needs none", "--numeric needs none"}};
  std::string out(message);
  if (message.find("::") == message.npos && message.find("table_format") == message.npos) return out;
  for (const auto& r : all)
    for (auto at = out.find(r.from); at != out.npos; at = out.find(r.from, at + r.to.size()))
      out.replace(at, r.from.size(), r.to);
  return out;
}

}  // namespace kte_tool
