#pragma once

#include <filesystem>
#include <string>

/// The robots of tests/data.
namespace kte::test {

inline std::filesystem::path robot_file(const std::string& name) {
  return std::filesystem::path(__FILE__).parent_path().parent_path() / "data" / "robots" / name;
}

/// A link that weighs, and what makes a URDF of links and joints.
inline std::string heavy(const std::string& link) {
  return "<link name='" + link +
         "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>\n";
}
inline std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                              const std::string& child, const std::string& rest = "<limit effort='1' velocity='1'/>") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         rest + "</joint>\n";
}
inline std::string urdf(const std::string& inside) { return "<robot name='r'>\n" + inside + "</robot>\n"; }

}  // namespace kte::test
