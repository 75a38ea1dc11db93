#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

/// Where files are that a robot's file names.
namespace kte::detail {

/// The path in a URI: what is behind `model://`, `package://`, `file://`, or all of it.
inline std::string path_in_uri(std::string_view uri) {
  for (const std::string_view scheme : {"model://", "package://", "file://"})
    if (uri.starts_with(scheme)) return std::string(uri.substr(scheme.size()));
  return std::string(uri);
}

/// Where a name may lead that a file in `folder` has: there, in the folders around it and in their folders `models`,
/// and then in those of a search path. An absolute one only to itself.
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

}  // namespace kte::detail
