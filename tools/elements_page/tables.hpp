#pragma once

#include <kte/contract/parameter_info.hpp>
#include <kte/elements/compiled_elements.hpp>

#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The tables of docs/elements.md, from the ports and parameters of the cores in elements/all.hpp. Units, descriptions
/// and the order of sections are those of the page.
namespace element_tables {

/// A row: a port or parameter of elements of some dimensions.
struct row {
  std::string name, what, description;
  std::vector<std::string> dimensions;

  bool same(const row& o) const { return name == o.name && what == o.what && description == o.description; }
  std::string text() const {
    std::string all;
    for (const auto& d : dimensions) all += (all.empty() ? "" : ", ") + d;
    return "| `" + name + "` | " + all + " | " + what + " | " + description + (description.empty() ? "|" : " |");
  }
};
inline std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(separator, from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + separator.size();
  }
  return parts;
}
inline row row_of_line(const std::string& line) {
  auto cells = split(line.substr(2), " | ");
  cells.resize(4);
  auto& last = cells[3];
  last = last.ends_with(" |") ? last.substr(0, last.size() - 2) : "";
  return {split(cells[0], "`").at(1), cells[2].ends_with(" |") ? cells[2].substr(0, cells[2].size() - 2) : cells[2],
          last, split(cells[1], ", ")};
}

/// Whether what the page calls a port or parameter is what it is: a vector may be a "unit vector" or an "axis z".
inline bool agrees(const std::string& on_page, const std::string& derived) {
  const std::string kind = split(on_page, ", ").at(0);
  return derived.starts_with("port")
             ? on_page == derived
             : kind == derived || (derived == "vector" && (kind == "unit vector" || kind == "axis z"));
}

/// "gen", "2D", "3D", or "-" of a type whose name has none, and the name before it.
inline std::pair<std::string, std::string> stem_and_dimension(const std::string& type) {
  for (const std::string d : {"gen", "2D", "3D"})
    if (type.ends_with("_" + d)) return {type.substr(0, type.size() - d.size() - 1), d};
  return {type, "-"};
}

using family = std::map<std::string, std::vector<row>>;  ///< by dimension, "gen" last, as '2' and '3' sort before 'g'

template <class Core>
void add_core(std::map<std::string, family>& all) {
  const auto [stem, dimension] = stem_and_dimension(std::string(std::string_view(Core::type)));
  auto& rows = all[stem][dimension];
  rows.clear();  // of several cores of a type the last has all parameters
  for (const auto& p : Core::ports) {
    const char* how = p.how == kte::access::on     ? "acts on"
                      : p.how == kte::access::out  ? "writes"
                      : p.how == kte::access::base ? "declares"
                      : p.how == kte::access::keep ? "keeps"
                                                   : "reads";
    rows.push_back({std::string(p.role), std::string("port, ") + how, "", {dimension}});
  }
  for (const auto& p : kte::parameter_infos<Core>())
    rows.push_back({std::string(p.name), std::string(p.what), p.optional ? "optional" : "", {dimension}});
}
inline std::map<std::string, family> families() {
  std::map<std::string, family> all;
  []<class... Core>(kte::detail::core_list<void, Core...>, auto& to) { (add_core<Core>(to), ...); }(
      kte::detail::all_cores{}, all);
  return all;
}

/// The table of a family; with units and descriptions of the rows that the page has now.
inline std::vector<row> table(const family& f, const std::vector<row>& on_page) {
  std::vector<row> rows = on_page;
  for (auto& r : rows) r.dimensions.clear();
  for (const std::string d : {"-", "gen", "2D", "3D"}) {
    if (!f.contains(d)) continue;
    std::size_t at = 0;
    for (row own : f.at(d)) {
      for (const auto& known : on_page) {
        if (known.name != own.name || !agrees(known.what, own.what)) continue;
        if (std::find(known.dimensions.begin(), known.dimensions.end(), d) == known.dimensions.end()) continue;
        own.what = known.what, own.description = known.description;
      }
      if (own.what.starts_with("port") && own.description.empty())  // the access has changed
        for (const auto& known : on_page)
          if (known.name == own.name && known.what.starts_with("port") &&
              std::find(known.dimensions.begin(), known.dimensions.end(), d) != known.dimensions.end())
            own.description = known.description;
      std::size_t found = at;
      while (found < rows.size() && !rows[found].same(own)) ++found;
      if (found == rows.size())
        rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(found = at), {own.name, own.what, own.description, {}});
      rows[found].dimensions.push_back(d), at = found + 1;
    }
  }
  std::erase_if(rows, [](const row& r) { return r.dimensions.empty(); });
  return rows;
}

/// The page with tables as they should be; elements that have no section follow at its end.
inline std::string with_tables(const std::string& page) {
  constexpr const char* head = "| name | dimension | type | description |\n|-|-|-|-|\n";
  auto all = families();
  std::string text, section;
  std::vector<row> rows;
  bool in_table = false;
  const auto write = [&](const std::string& stem) {
    for (const auto& r : table(all.at(stem), rows)) text += r.text() + "\n";
    all.erase(stem), rows.clear();
  };
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) section = line.starts_with("## `") ? split(line, "`")[1] : "";
    if (in_table && line.starts_with("| `")) {
      rows.push_back(row_of_line(line));
      continue;
    }
    if (std::exchange(in_table, line == "|-|-|-|-|" && all.contains(section))) write(section);
    text += line + "\n";
  }
  if (in_table) write(section);
  while (!all.empty()) {
    const std::string stem = all.begin()->first;
    text += "\n## `" + stem + "`\n\n" + head;
    write(stem);
  }
  return text;
}

}  // namespace element_tables
