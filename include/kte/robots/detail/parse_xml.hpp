#pragma once

#include <kte/robots/detail/xml_text.hpp>

#include <tinyxml2.h>

namespace kte::detail {

/// Copies an element; tinyxml2 has rejected too deep nesting.
[[gnu::cold]] inline void copy_node(const tinyxml2::XMLElement& e, xml_node& n) {
  n.name = e.Name(), n.line = e.GetLineNum();
  for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next())
    n.attributes.emplace_back(a->Name(), a->Value());
  if (const char* t = e.GetText()) n.text = t;
  for (const auto* c = e.FirstChildElement(); c != nullptr; c = c->NextSiblingElement())
    copy_node(*c, n.children.emplace_back());
}

/// The number of bytes that follow the end of a URDF and are neither elements nor comments. Readers of URDF ignore
/// them: they become an attribute of the root, which is listed as not read.
[[gnu::cold]] inline std::size_t bytes_after_robot(std::string_view text) {
  constexpr std::string_view close = "</robot>";
  const auto at = text.rfind(close);
  if (at == text.npos) return 0;
  const auto rest = text.substr(at + close.size());
  const auto first = rest.find_first_not_of(" \t\r\n");
  return first == rest.npos || rest[first] == '<' ? 0 : rest.size();
}

/// Reads the root of a text in XML by tinyxml2, which is used only here (docs/decisions/15-robot-files.md). Throws
/// `bad_file` with the line.
[[gnu::cold]] inline xml_node parse_xml(std::string_view text, const std::string& source) {
  const auto rest = bytes_after_robot(text);
  const auto good = checked_text(text.substr(0, text.size() - rest), source);
  tinyxml2::XMLDocument doc;
  doc.Parse(good.data(), good.size());
  if (doc.Error()) fail_xml_syntax(source, doc.ErrorLineNum(), doc.ErrorName());
  const auto* root = doc.RootElement();
  if (root == nullptr) fail_xml(source, 0, "the file has no element");
  if (const auto* second = root->NextSiblingElement())
    fail_xml(source, second->GetLineNum(), "an element comes after the end of the first");
  xml_node all;
  copy_node(*root, all);
  if (rest > 0) all.attributes.emplace_back("text after </robot>", "");
  give_titles(all, source);
  return all;
}

/// Reads the root of a file that another file refers to (`xml_parser`).
[[gnu::cold]] inline xml_node parse_xml_file(const std::filesystem::path& path) {
  auto all = parse_xml(text_of_file(path), path.string());
  give_file(all, path.string());
  return all;
}

}  // namespace kte::detail
