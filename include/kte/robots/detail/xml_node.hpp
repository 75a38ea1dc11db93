#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kte::detail {

/// An element of an XML file, read. What reads robots from it needs no library of XML, and is part of kte::compiled.
struct xml_node {
  std::string name;
  int line = 0;
  std::string file;   ///< of what an included file has, its name; else empty
  std::string title;  ///< for messages: "joint 'elbow'", of what has no name "joint 'elbow': <origin>"
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< between the tags
  std::vector<xml_node> children;
};

}  // namespace kte::detail
