#pragma once

#include <kte/robots/description.hpp>
#include <kte/robots/detail/file_places.hpp>
#include <kte/robots/options.hpp>

namespace kte_tool {

/// The file among those that the file of a robot refers to (included files, assets, meshes) that an output would
/// replace, by whatever path or link; empty if there is none.
inline std::string file_of_robot_at(const std::filesystem::path& output, const kte::robot_description& d,
                                    const kte::robot_options& o) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(output, none)) return {};
  const auto is_it = [&](const std::filesystem::path& p) { return std::filesystem::equivalent(output, p, none); };
  for (const auto& file : d.files)
    if (is_it(file)) return file;
  for (const auto& l : d.links)
    for (const auto* shapes : {&l.visuals, &l.collisions})
      for (const auto& s : *shapes) {
        if (s.mesh.empty()) continue;
        const auto folder = std::filesystem::path(l.file.empty() ? d.source : l.file).parent_path();
        const auto mesh = kte::detail::find_mesh_file(s.mesh, folder, o.search_path);
        if (!mesh.empty() && is_it(mesh)) return mesh.string();
      }
  return {};
}

}  // namespace kte_tool
