#pragma once

#include <kte/robots/detail/xml_parser.hpp>
#include <kte/robots/detail/xml_text.hpp>

#include <tinyxml2.h>

namespace kte::detail {

/// Copies an element; tinyxml2 has rejected too deep nesting.
[[gnu::cold]] inline void copy_element(const tinyxml2::XMLElement& e, xml_node& n) {
  std::size_t attributes = 0, children = 0;  // reserved: moving elements takes as long as reading them
  for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next()) ++attributes;
  for (const auto* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) ++children;
  begin_element(n, e.Name(), e.GetLineNum(), attributes, children);
  for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next()) add_attribute(n, a->Name(), a->Value());
  if (const char* t = e.GetText()) set_text(n, t);
  for (const auto* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) copy_element(*c, add_child(n));
}

/// The `xml_parser` by tinyxml2, which is used only here (docs/decisions/15-robot-files.md).
[[gnu::cold]] inline void parse_xml(std::string_view text, const std::string& source, xml_node& to) {
  tinyxml2::XMLDocument doc;
  doc.Parse(text.data(), text.size());
  if (doc.Error()) fail_xml_syntax(source, doc.ErrorLineNum(), doc.ErrorName());
  const auto* root = doc.RootElement();
  if (root == nullptr) fail_xml(source, 0, "the file has no element");
  if (const auto* second = root->NextSiblingElement())
    fail_xml(source, second->GetLineNum(), "an element comes after the end of the first");
  copy_element(*root, to);
}

}  // namespace kte::detail
