#pragma once

#include <kte/math/vec.hpp>
#include <kte/view/scene.hpp>

#include <filesystem>
#include <map>

namespace kte::view {

/// The meshes that a robot's file names, each read once.
class mesh_files {
 public:
  /// `file` is the robot's; meshes are looked for around it.
  mesh_files(scene& s, std::string file, std::vector<std::string> search_path)
      : scene_(s), file_(std::move(file)), search_path_(std::move(search_path)) {}

  /// The index in the scene of a mesh, named as written in the file `from` (the robot's own if empty). -1 where it
  /// cannot be drawn: why is then a note of the scene, with the first link that has it.
  int index_of(const std::string& name, const vec3<>& scale, std::string_view from, std::string_view link);

 private:
  /// The folder of a file that names meshes.
  std::filesystem::path folder_of(std::string_view from) const;
  std::filesystem::path find(const std::string& name, std::string_view from) const;
  int read(const std::string& uri, const vec3<>& scale, std::string_view from);
  int cannot(const std::string& name, const std::string& why);
  /// The name of a mesh in a page, without folders of this machine: as the robot's file has it; an absolute one
  /// relative to this file, or without its folders.
  std::string shown(const std::string& name, std::string_view from) const;

  scene& scene_;
  std::string file_;
  std::vector<std::string> search_path_;
  std::string link_;  ///< for which a mesh is read
  std::map<std::pair<std::string, std::array<double, 3>>, int> known_;
};

}  // namespace kte::view
