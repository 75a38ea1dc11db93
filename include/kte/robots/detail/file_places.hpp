#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

/// Searches for the files that the file of a robot refers to.
namespace kte::detail {

/// The path in a URI: the part after `model://`, `package://` or `file://`, or the whole text.
inline std::string path_in_uri(std::string_view uri) {
  for (const std::string_view scheme : {"model://", "package://", "file://"})
    if (uri.starts_with(scheme)) return std::string(uri.substr(scheme.size()));
  return std::string(uri);
}

/// The paths to try for a file name in a file of `folder`: that folder, its parents and their folders `models`, then
/// the folders of the search path. An absolute name has one path only.
inline std::vector<std::filesystem::path> file_places(const std::string& name, const std::filesystem::path& folder,
                                                      const std::vector<std::string>& search_path) {
  using std::filesystem::path;
  const path wanted(name);
  if (wanted.is_absolute()) return {wanted};
  std::vector<path> all;
  std::error_code none;
  for (path at = std::filesystem::absolute(folder, none).lexically_normal();; at = at.parent_path()) {
    all.push_back(at / wanted), all.push_back(at / "models" / wanted);
    if (at == at.parent_path()) break;
  }
  for (const auto& s : search_path) all.push_back(path(s) / wanted);
  return all;
}

/// The file of a mesh by its URI, in the folders of `file_places`; of `package://name/...` and `model://name/...` also
/// where the folder has another name; empty if there is none.
inline std::filesystem::path find_mesh_file(const std::string& uri, const std::filesystem::path& folder,
                                            const std::vector<std::string>& search_path) {
  const auto path = path_in_uri(uri);
  auto places = file_places(path, folder, search_path);
  if (uri.starts_with("package://") || uri.starts_with("model://"))
    if (const auto slash = path.find('/'); slash != path.npos)
      for (auto& p : file_places(path.substr(slash + 1), folder, search_path)) places.push_back(std::move(p));
  places.emplace_back(path);
  std::error_code none;
  for (auto& p : places)
    if (std::filesystem::is_regular_file(p, none)) return std::move(p);
  return {};
}

}  // namespace kte::detail
