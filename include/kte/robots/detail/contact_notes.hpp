#pragma once

#include <kte/robots/description.hpp>

#include <map>
#include <set>

namespace kte::detail {

/// Warnings about shapes without the contact of their file: one for each reason, with the first names.
class contact_notes {
 public:
  void add(const std::string& reason, const robot_link& l, const robot_shape& s) {
    auto& g = groups_[reason];
    if (g.names.empty()) g.line = s.line, g.file = l.file;
    if (g.known.insert(l.name).second) g.names.push_back(l.name);
  }
  void finish(std::vector<robot_note>& warnings) const {
    for (const auto& [reason, g] : groups_) {
      std::string all;
      for (std::size_t i = 0; i < g.names.size() && i < 3; ++i) all += (i > 0 ? ", '" : "'") + g.names[i] + "'";
      if (g.names.size() > 3) all += " and " + std::to_string(g.names.size() - 3) + " more";
      warnings.push_back({g.line, "contacts of " + all + ": " + reason, g.file, true});
    }
  }

 private:
  struct group {
    int line = 0;
    std::string file{};
    std::vector<std::string> names{};  ///< of links
    std::set<std::string> known{};     ///< the same names
  };
  std::map<std::string, group> groups_;
};

}  // namespace kte::detail
