#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

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
/// What a text must hold, and what not: `CHECK(text == (holding("a") && !holding("b")))`.
class holding {
 public:
  explicit holding(std::string part) : parts_{{std::move(part), true}} {}
  holding operator!() const {
    auto all = *this;
    for (auto& [part, there] : all.parts_) there = !there;
    return all;
  }
  friend holding operator&&(holding a, const holding& b) {
    a.parts_.insert(a.parts_.end(), b.parts_.begin(), b.parts_.end());
    return a;
  }
  friend bool operator==(const std::string& text, const holding& h) {
    for (const auto& [part, there] : h.parts_)
      if ((text.find(part) != text.npos) != there) return false;
    return true;
  }
  friend std::ostream& operator<<(std::ostream& out, const holding& h) {
    for (const auto& [part, there] : h.parts_) out << (there ? "with:\n" : "without:\n") << part << '\n';
    return out;
  }

 private:
  std::vector<std::pair<std::string, bool>> parts_;
};
inline std::string urdf(const std::string& inside) { return "<robot name='r'>\n" + inside + "</robot>\n"; }

}  // namespace kte::test
