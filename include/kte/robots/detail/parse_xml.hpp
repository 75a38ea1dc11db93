#pragma once

#include <kte/robots/detail/xml_text.hpp>
#include <kte/robots/detail/xml_title.hpp>

#include <tinyxml2.h>

namespace kte::detail {

/// Copies an element; tinyxml2 has rejected too deep nesting.
[[gnu::cold]] inline void copy_node(const tinyxml2::XMLElement& e, xml_node& n) {
  n.name = e.Name(), n.line = e.GetLineNum();
  std::size_t attributes = 0, children = 0;  // reserved: moving elements takes as long as reading them
  for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next()) ++attributes;
  for (const auto* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement()) ++children;
  n.attributes.reserve(attributes), n.children.reserve(children);
  for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next())
    n.attributes.emplace_back(a->Name(), a->Value());
  if (const char* t = e.GetText()) n.text = t;
  for (const auto* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement())
    copy_node(*c, n.children.emplace_back());
}

/// Reads the root of a text in XML by tinyxml2, which is used only here (docs/decisions/15-robot-files.md). Throws
/// `bad_file` with the line.
[[gnu::cold]] inline xml_node parse_xml(std::string_view text, const std::string& source) {
  const auto good = checked_text(text, source);
  tinyxml2::XMLDocument doc;
  doc.Parse(good.data(), good.size());
  if (doc.Error()) fail_xml_syntax(source, doc.ErrorLineNum(), doc.ErrorName());
  const auto* root = doc.RootElement();
  if (root == nullptr) fail_xml(source, 0, "the file has no element");
  if (const auto* second = root->NextSiblingElement())
    fail_xml(source, second->GetLineNum(), "an element comes after the end of the first");
  xml_node all;
  copy_node(*root, all);
  give_titles(all, source, good.data() + good.size() != text.data() + text.size());
  return all;
}

}  // namespace kte::detail
