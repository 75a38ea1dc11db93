#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/detail/xml_node.hpp>

namespace kte::detail {

/// The title of an element in messages: "joint 'elbow'", for an element without a name "joint 'elbow': <origin>", for
/// one of several shapes "link 'arm': second <visual>".
std::string title_of(const xml_node& n);
/// Sets what the titles of all elements need; throws `bad_file` for elements of xacro. Text that was cut off after the
/// root becomes an attribute, which is listed as not read.
void give_titles(xml_node& root, const std::string& source, bool is_cut);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/io/source_text.hpp>
#  include <kte/robots/detail/shape_names.hpp>
#  include <kte/robots/detail/xml_text.hpp>

#  include <array>

namespace kte::detail {

inline const std::string* name_of(const xml_node& n) {
  for (const auto& [key, value] : n.attributes)
    if (key == "name") return &value;
  return nullptr;
}
KTE_FUNCTION std::string title_of(const xml_node& n) {
  if (const auto* const name = name_of(n)) return excerpt(n.name) + " '" + excerpt(*name) + "'";
  return (n.owner ? *n.owner : "") + (n.place > 0 ? ordinal(n.place) + " " : "") + "<" + excerpt(n.name) + ">";
}
/// `owner`: that of the element, for the root null.
inline void give_title(xml_node& n, const std::string& source, const std::shared_ptr<const std::string>& owner,
                       bool top, std::size_t place = 0) {
  if (n.name.starts_with("xacro:"))
    fail_xml(source, n.line,
             "<" + excerpt(n.name) +
                 ">: this is a file for xacro, not a robot yet: run xacro, and read the file that it writes");
  n.owner = owner, n.place = place;
  if (n.children.empty()) return;
  const bool titled = !top && (place > 0 || name_of(n) != nullptr);
  const auto below = titled ? std::make_shared<const std::string>(title_of(n) + ": ") : owner;
  constexpr std::array<std::string_view, 3> shapes{"visual", "collision", "geom"};
  std::array<std::size_t, 4> count{}, seen{};
  const auto kind = [&](const xml_node& c) {
    return static_cast<std::size_t>(std::find(shapes.begin(), shapes.end(), c.name) - shapes.begin());
  };
  for (const auto& c : n.children) ++count[kind(c)];
  for (auto& c : n.children) {
    const auto k = kind(c);
    give_title(c, source, below, false, k < 3 && count[k] > 1 ? ++seen[k] : 0);
  }
}
KTE_FUNCTION void give_titles(xml_node& root, const std::string& source, bool is_cut) {
  if (is_cut) root.attributes.emplace_back("text after </robot>", "");
  give_title(root, source, {}, true);
}

}  // namespace kte::detail
#endif
