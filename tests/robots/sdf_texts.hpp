#pragma once

#include <kte/robots/description.hpp>

#include <string>
#include <vector>

/// What makes texts of SDF.
namespace kte::test {

inline std::string sdf(const std::string& inside, const std::string& version = "1.11") {
  return "<sdf version='" + version + "'>" + inside + "</sdf>";
}
inline std::string model(const std::string& inside, const std::string& version = "1.11") {
  return sdf("<model name='m'>" + inside + "</model>", version);
}
inline std::string link_text(const std::string& name, const std::string& rest = "") {
  return "<link name='" + name + "'>" + rest + "<inertial><mass>1</mass><inertia/></inertial></link>";
}
inline std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const std::string& rest = "<axis/>") {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" +
         rest + "</joint>";
}
inline bool has(const std::vector<robot_note>& notes, const std::string& text, bool moves = false) {
  for (const auto& n : notes)
    if (n.text.find(text) != std::string::npos && n.changes_motion == moves) return true;
  return false;
}
inline const mat3<vec3<>> x90{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
inline const std::string turned = "<pose>0 0 0 1.5707963267948966 0 0</pose>";

}  // namespace kte::test
