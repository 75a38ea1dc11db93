#pragma once

#include <string>
#include <utility>
#include <vector>

namespace kte::detail {

/// An element of an XML file after reading. The readers of robots use it without an XML library, and are part of
/// kte::compiled.
struct xml_node {
  std::string name;
  int line = 0;
  std::string file;   ///< name of the included file that it is in; empty for the robot's own
  std::string title;  ///< for messages: "joint 'elbow'", for an element without a name "joint 'elbow': <origin>"
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< between the tags
  std::vector<xml_node> children;
};

}  // namespace kte::detail
