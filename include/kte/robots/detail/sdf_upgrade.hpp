#pragma once

#include <kte/robots/detail/sdf_values.hpp>

#include <charconv>

namespace kte::detail {

/// The second number of a version "1.N", or -1.
inline int sdf_version(std::string_view text) {
  int minor = -1;
  if (!text.starts_with("1.")) return -1;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), minor);
  return error == std::errc{} && end == text.data() + text.size() ? minor : -1;
}

/// Converts a file of an older version to the newest: axes were in the frame of the model up to 1.4, optionally up to
/// 1.6 by <use_parent_model_frame>, now expressed_in="__model__"; poses had `frame`, now `relative_to`; gravity was in
/// <physics> up to 1.5.
class sdf_upgrade {
 public:
  static constexpr int newest = 12;

  explicit sdf_upgrade(robot_description& d) : d_(d) {}

  void apply(xml_node& root) {
    const xml_item x(root, d_);
    version_ = x.has("version") ? sdf_version(x.text("version")) : newest;
    if (!x.has("version")) x.warn("has no version: it is read as 1.12");
    if (version_ < 0 || version_ > newest) {
      x.warn("version '" + excerpt(x.text("version")) + "' is not known: it is read as 1.12");
      version_ = newest;
    }
    if (version_ < 7) elements(root);
  }

 private:
  void elements(xml_node& n) const {
    if (n.name == "plugin") return;
    if (n.name == "pose")
      for (auto& [key, value] : n.attributes)
        if (key == "frame") key = "relative_to";
    if (n.name == "world" && version_ < 6) gravity(n);
    const bool joint = n.name == "joint";
    for (auto& c : n.children) {
      if (joint && (c.name == "axis" || c.name == "axis2")) axis(c);
      elements(c);
    }
  }
  void axis(xml_node& n) const {
    bool in_model = version_ < 5;
    for (auto it = n.children.begin(); it != n.children.end();) {
      if (it->name != "use_parent_model_frame") {
        ++it;
        continue;
      }
      const auto text = trimmed(it->text);
      if (!text.empty()) in_model = flag({*it, d_}, text);
      it = n.children.erase(it);
    }
    if (!in_model) return;
    auto xyz = std::find_if(n.children.begin(), n.children.end(), [](const auto& c) { return c.name == "xyz"; });
    if (xyz == n.children.end()) {
      xyz = n.children.insert(xyz, xml_node{});
      xyz->name = "xyz", xyz->line = n.line, xyz->file = n.file, xyz->owner = n.owner;
    }
    xyz->attributes.emplace_back("expressed_in", "__model__");
  }
  static void gravity(xml_node& world) {
    for (const auto& p : world.children)
      if (p.name == "physics")
        for (const auto& g : p.children)
          if (g.name == "gravity") {
            auto found = g;
            world.children.push_back(std::move(found));
            return;
          }
  }

  robot_description& d_;
  int version_ = newest;
};

}  // namespace kte::detail
