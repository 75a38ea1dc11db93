#pragma once

#include <kte/contract/record.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

/// docs/elements.md as records: of each element its ports, and its parameters with some numbers of their kind.
namespace elements_page {

inline std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + separator.size();
  }
  return parts;
}

inline std::vector<double> numbers_of(const std::string& what) {
  static const std::map<std::string, std::vector<double>> known{{"number", {1}},
                                                                {"list", {1, 2}},
                                                                {"flag", {1}},
                                                                {"vector", {1, 0, 0}},
                                                                {"unit vector", {1, 0, 0}},
                                                                {"axis z", {0, 0, 1}},
                                                                {"rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                                                                {"matrix", {0, 0, 0, 0, 0, 0, 0, 0, 0}},
                                                                {"symmetric matrix", {0, 0, 0, 0, 0, 0}}};
  const auto found = known.find(what);
  if (found == known.end()) throw std::runtime_error("elements.md: what is a '" + what + "'?");
  return found->second;
}

/// A section is called "## `spring`"; a row of it is "| `stiffness` | 2D, 3D | number, N/m | ... |".
inline std::map<std::string, kte::element_record> records() {
  std::ifstream page(std::filesystem::path(__FILE__).lexically_normal().parent_path().parent_path().parent_path() /
                     "docs" / "elements.md");
  std::map<std::string, kte::element_record> all;
  std::string family;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) family = line.starts_with("## `") ? split(line, "`")[1] : "";
    if (family.empty() || !line.starts_with("| `")) continue;
    const auto cells = split(line, " | ");
    const std::string name = split(cells.at(0), "`").at(1), what = split(cells.at(2), ", ").at(0);
    for (const auto& dimension : split(cells.at(1), ", ")) {
      const std::string type = dimension == "-" ? family : family + "_" + dimension;
      auto& r = all[type];
      r.type = type;
      if (what == "port") {
        r.connections.push_back({name, "the " + name});
      } else {
        r.parameters.push_back({name, numbers_of(what)});
      }
    }
  }
  return all;
}

}  // namespace elements_page
