#pragma once

#include <kte/robots/load_robot.hpp>

#include "catch.hpp"

/// MJCF as text, and what reading it says.
namespace kte::test::mjcf_texts {

inline std::string mjcf(const std::string& inside, const std::string& before = "") {
  return "<mujoco>" + before + "<worldbody>\n" + inside + "</worldbody></mujoco>";
}
inline robot robot_of(const std::string& text, const robot_options& options = {}) {
  return to_robot(describe_robot(text, "a.xml", options), options);
}
inline std::string texts(const std::vector<robot_note>& notes) {
  std::string all;
  for (const auto& n : notes) all += n.text + "\n";
  return all;
}
inline const std::string heavy = "<inertial pos='0 0 1' mass='2' diaginertia='1 1 1'/>";

}  // namespace kte::test::mjcf_texts
