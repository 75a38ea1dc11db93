#pragma once

#include <kte/robots/detail/file_places.hpp>
#include <kte/robots/detail/included_file.hpp>
#include <kte/robots/detail/sdf_upgrade.hpp>

namespace kte::detail {

/// Finds the file of a URI: `model://name`, `package://name`, `file://path`, or a path. Relative paths are searched in
/// the folder of the file that contains them, in its parents and their folders `models`, and then in
/// robot_options::search_path. A folder stands for a model, whose `model.config` names the file.
class sdf_search {
 public:
  using path = std::filesystem::path;

  sdf_search(robot_description& d, const robot_options& o, xml_parser parse) : d_(d), options_(o), parse_(parse) {}

  path find(const xml_item& x, const std::string& uri, const path& folder) const {
    const std::string name = path_in_uri(uri);
    if (name.find("://") != name.npos)
      x.fail("'" + excerpt(uri) + "' is not on this machine: fetch it, and name its folder by model://, a path, or " +
             "robot_options::search_path");
    for (const auto& at : file_places(name, folder, options_.search_path)) {
      std::error_code none;
      if (std::filesystem::is_regular_file(at, none)) return at;
      if (std::filesystem::is_directory(at, none))
        if (auto file = model_in(x, at); !file.empty()) return file;
    }
    x.fail("'" + excerpt(uri) + "' is not found, neither in the folders around '" +
           (folder.empty() ? "." : folder.string()) + "' nor in those of robot_options::search_path");
  }

 private:
  /// The file that `model.config` names for the highest supported version, otherwise model.sdf.
  path model_in(const xml_item& x, const path& folder) const {
    std::error_code none;
    int highest = -1;
    auto file = folder / "model.sdf";
    if (const auto config = folder / "model.config"; std::filesystem::is_regular_file(config, none)) {
      const auto root = included_file(x, config, parse_);
      for (const auto& c : root.children) {
        if (c.name != "sdf") continue;
        const int version = sdf_version(xml_item(c, d_).text_or("version", "1.0"));
        if (version <= highest || version > sdf_upgrade::newest) continue;
        highest = version, file = folder / trimmed(c.text);
      }
    }
    return std::filesystem::is_regular_file(file, none) ? file : path();
  }

  robot_description& d_;
  const robot_options& options_;
  xml_parser parse_;
};

}  // namespace kte::detail
