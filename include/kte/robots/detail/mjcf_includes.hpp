#pragma once

#include <kte/errors.hpp>
#include <kte/robots/detail/included_file.hpp>
#include <kte/robots/detail/xml_item.hpp>

#include <algorithm>
#include <filesystem>
#include <set>

namespace kte::detail {

/// Replaces elements <include file="..."/> by the contents of the files, whatever their root elements. File names are
/// relative to the folder of the robot's file, otherwise to the folder of the including file. As in MuJoCo a file is
/// included at most once, which also bounds the size.
class mjcf_includes {
 public:
  mjcf_includes(robot_description& d, const std::filesystem::path& folder, xml_parser parse)
      : d_(d), parse_(parse), folder_(folder) {
    seen_.insert(canonical(d.source));
  }

  void resolve(xml_node& n) { resolve_in(folder_, n, 0); }

 private:
  static std::filesystem::path canonical(const std::filesystem::path& path) {
    std::error_code none;
    const auto known = std::filesystem::weakly_canonical(path, none);
    return none ? path : known;
  }
  void resolve_in(const std::filesystem::path& folder, xml_node& n, int depth) {
    if (depth > deepest_element) xml_item(n, d_).fail("elements nest deeper than " + std::to_string(deepest_element));
    if (std::none_of(n.children.begin(), n.children.end(), [](const auto& c) { return c.name == "include"; })) {
      for (auto& c : n.children) resolve_in(folder, c, depth + 1);
      return;
    }
    std::vector<xml_node> all;
    for (auto& c : n.children) {
      if (c.name != "include") {
        resolve_in(folder, c, depth + 1), all.push_back(std::move(c));
        continue;
      }
      const auto path = file_of({c, d_}, folder);
      auto file = included_file({c, d_}, path, parse_);
      resolve_in(path.parent_path(), file, depth);
      for (auto& x : file.children) all.push_back(std::move(x));
    }
    n.children = std::move(all);
  }
  std::filesystem::path file_of(const xml_item& x, const std::filesystem::path& folder) {
    const auto name = path_of_text(x.text("file"));
    x.only({}, {"file"});
    auto path = folder_ / name;
    if (!is_file(path)) path = folder / name;
    if (!is_file(path)) x.fail("there is no file '" + excerpt(name.string()) + "' in the folder of the robot's file");
    if (!seen_.insert(canonical(path)).second)
      x.fail("the file '" + excerpt(name.string()) + "' is included already; a file is included once");
    d_.files.push_back(path.string());
    return path;
  }

  robot_description& d_;
  xml_parser parse_;
  std::filesystem::path folder_;
  std::set<std::filesystem::path> seen_;
};

}  // namespace kte::detail
