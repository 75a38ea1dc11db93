#pragma once

#include <kte/robots/detail/contact_leftovers.hpp>
#include <kte/robots/detail/sdf_values.hpp>

namespace kte::detail {

/// Collects contents that are not modelled and occur many times: one warning per kind.
class sdf_leftovers {
 public:
  contact_leftovers contacts;

  void surface(const xml_item& x) { surfaces_.push_back(x); }
  void plugin(const xml_item& x) { (acts_on_joints(x.node()) ? driving_ : others_).push_back(x); }

  void warn() const {
    contacts.warn();
    if (!surfaces_.empty())
      surfaces_[0].moves_differently("contacts are not modelled: it is not read" + also(surfaces_.size()));
    if (!driving_.empty()) driving_[0].moves_differently("plugins that act on joints are not read:" + names(driving_));
    if (!others_.empty()) others_[0].warn("plugins are not read:" + names(others_));
  }

 private:
  static std::string also(std::size_t count) {
    return count > 1 ? ", as all " + std::to_string(count) + " of the model" : std::string();
  }
  static std::string names(const std::vector<xml_item>& all) {
    std::string text;
    for (const auto& p : all)
      text += (text.empty() ? " '" : ", '") + excerpt(p.text_or("name", p.text_or("filename", "").c_str())) + "'";
    return text;
  }
  static bool says(std::string text, std::string_view what) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text.find(what) != text.npos;
  }
  /// Whether a plugin acts on joints: it refers to joints and does not only publish their states.
  static bool acts_on_joints(const xml_node& plugin) {
    for (const auto& [key, value] : plugin.attributes)
      if (says(value, "publisher")) return false;
    return speaks_of_joints(plugin);
  }
  static bool speaks_of_joints(const xml_node& n) {
    if (says(n.name, "joint")) return true;
    for (const auto& [key, value] : n.attributes)
      if (says(value, "joint")) return true;
    return std::any_of(n.children.begin(), n.children.end(), speaks_of_joints);
  }

  std::vector<xml_item> surfaces_, driving_, others_;
};

}  // namespace kte::detail
