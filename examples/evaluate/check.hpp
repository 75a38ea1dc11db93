#pragma once

#include <kte/robots/check_robot.hpp>

#include "evaluate/robot_file.hpp"

namespace evaluate {

inline std::vector<kte::robot_note> not_read(const kte::robot_description& d, const kte::robot_options& wanted) {
  try {
    return kte::to_robot(d, wanted).not_read;
  } catch (const kte::error&) {  // which is one of the findings
    return d.not_read;
  }
}

/// What --check prints: what is odd about the robot, then what of its file was not read.
inline std::string check_text(const options& o) {
  const auto bytes = kte::detail::text_of_file(o.robot);
  if (kte::detail::model_format_in(bytes, o.robot))
    throw kte::bad_argument("kte: --check takes the file of a robot, and " + o.robot.string() + " is a model file");
  const auto wanted = robot_options_of(o);
  const auto robot = kte::describe_robot(bytes, o.robot.string(), wanted);
  std::string s;
  for (const auto& text : texts_of(check_robot(robot, wanted), o.robot.string())) s += text + '\n';
  if (s.empty()) s = o.robot.string() + ": nothing odd is found\n";
  const auto ignored = texts_of(not_read(robot, wanted), "");
  if (!ignored.empty()) s += "not read (" + std::to_string(ignored.size()) + "):\n";
  for (const auto& text : ignored) s += "  " + text + '\n';
  return s;
}

}  // namespace evaluate
