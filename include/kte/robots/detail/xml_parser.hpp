#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/detail/xml_node.hpp>

/// Between the XML library, which the caller's program compiles, and the readers of robots, which are compiled once.
namespace kte::detail {

/// Makes the root of a text in XML, and all elements in it, by the functions below. Throws `bad_file` for a text that
/// is not valid XML; `source` names it in messages.
using xml_parser = void (*)(std::string_view text, const std::string& source, xml_node& root);

/// Sets the name of an element, and reserves memory for what it has.
void begin_element(xml_node& n, const char* name, int line, std::size_t attributes, std::size_t children);
void add_attribute(xml_node& n, const char* name, const char* value);
void set_text(xml_node& n, const char* text);
/// A new element, the last of those in n.
xml_node& add_child(xml_node& n);

/// The root of a text in XML, with the titles of all elements. Throws `bad_file` with the line.
xml_node parsed(std::string_view text, const std::string& source, xml_parser parse);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/xml_text.hpp>
#  include <kte/robots/detail/xml_title.hpp>

namespace kte::detail {
KTE_FUNCTION void begin_element(xml_node& n, const char* name, int line, std::size_t attributes, std::size_t children) {
  n.name = name, n.line = line;
  n.attributes.reserve(attributes), n.children.reserve(children);
}
KTE_FUNCTION void add_attribute(xml_node& n, const char* name, const char* value) {
  n.attributes.emplace_back(name, value);
}
KTE_FUNCTION void set_text(xml_node& n, const char* text) { n.text = text; }
KTE_FUNCTION xml_node& add_child(xml_node& n) { return n.children.emplace_back(); }
KTE_FUNCTION xml_node parsed(std::string_view text, const std::string& source, xml_parser parse) {
  const auto good = checked_text(text, source);
  xml_node root;
  parse(good, source, root);
  give_titles(root, source, good.data() + good.size() != text.data() + text.size());
  return root;
}
}  // namespace kte::detail
#endif
