#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kte::detail {

/// Whether two names are equal; inlined, as readers compare names more often than they do anything else.
inline bool same_name(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size()) == 0;
}

/// An element of an XML file after reading. The readers of robots use it without an XML library, and are part of
/// kte::compiled.
struct xml_node {
  std::string name;
  int line = 0;
  std::string file;  ///< name of the included file that it is in; empty for the robot's own
  /// The title of the nearest element around it with a name or a number, and ": "; null: there is none.
  std::shared_ptr<const std::string> owner;
  std::size_t place = 0;  ///< of a shape of several, its place among those of its link, from 1
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string text;  ///< between the tags
  std::vector<xml_node> children;
};

}  // namespace kte::detail
