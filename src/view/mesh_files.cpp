#include "mesh_files.hpp"

#include <kte/io/file.hpp>
#include <kte/robots/detail/file_places.hpp>
#include <kte/robots/detail/mesh_file.hpp>

#include <algorithm>
#include <set>

#include "triangles.hpp"

namespace kte::view {

namespace {
constexpr std::uintmax_t largest_file = std::uintmax_t{256} << 20;
constexpr std::size_t most_meshes = 10000;

std::string bytes_text(std::uintmax_t n) { return std::to_string(n >> 20) + " MiB"; }
}  // namespace

int mesh_files::index_of(const std::string& name, const vec3<>& scale, std::string_view from, std::string_view link) {
  link_ = link;
  const auto [known, fresh] =
      known_.emplace(std::pair(std::string(from) + '\n' + name, std::array{scale.x, scale.y, scale.z}), -1);
  if (fresh) known->second = read(name, scale, from);
  return known->second;
}

std::string mesh_files::shown(const std::string& name, std::string_view from) const {
  const std::filesystem::path path = detail::path_in_uri(name);
  if (!path.is_absolute()) return name;
  std::error_code none;
  const auto inside =
      path.lexically_normal().lexically_relative(std::filesystem::absolute(folder_of(from), none).lexically_normal());
  return (inside.empty() || *inside.begin() == ".." ? path.filename() : inside).string();
}

int mesh_files::cannot(const std::string& name, const std::string& why) {
  const auto note = "mesh '" + name + "' is not drawn: " + why + " (link '";
  if (std::none_of(scene_.notes.begin(), scene_.notes.end(), [&](const auto& n) { return n.starts_with(note); }))
    scene_.notes.push_back(note + link_ + "')");
  return -1;
}

std::filesystem::path mesh_files::folder_of(std::string_view from) const {
  return std::filesystem::path(from.empty() ? file_ : std::string(from)).parent_path();
}
std::filesystem::path mesh_files::find(const std::string& name, std::string_view from) const {
  return detail::find_mesh_file(name, folder_of(from), search_path_);
}

int mesh_files::read(const std::string& uri, const vec3<>& scale, std::string_view from) {
  const auto name = shown(uri, from);
  if (name.empty()) return cannot(name, "the file does not name one; meshes written in the file itself are not read");
  if (scene_.meshes.size() == most_meshes) return cannot(name, "there are " + std::to_string(most_meshes) + " already");
  const auto extension = detail::lower_extension(name);
  if (extension != ".stl" && extension != ".obj" && extension != ".msh")
    return cannot(name, "only .stl, .obj and .msh are read");
  const auto path = find(uri, from);
  if (path.empty())
    return cannot(name,
                  "it is not found, neither in the folders around the robot's file nor in those of "
                  "robot_options::search_path");
  std::error_code none;
  const auto size = std::filesystem::file_size(path, none);
  if (!none && size > largest_file)
    return cannot(name, "its file has " + bytes_text(size) + ", above " + bytes_text(largest_file));
  try {
    const auto mesh = detail::placed_mesh(detail::read_mesh(path), {}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, scale);
    if (mesh.faces.empty()) return cannot(name, "it has vertices, but no faces");
    auto drawn = merged(mesh);
    drawn.name = std::filesystem::path(detail::path_in_uri(name)).filename().string();
    if (drawn.indices.empty()) return cannot(name, "all its triangles are without area, or too large for floats");
    scene_.meshes.push_back(std::move(drawn));
    return static_cast<int>(scene_.meshes.size()) - 1;
  } catch (const error& e) {
    std::string why = std::string(e.what()).substr(5);
    if (const auto at = why.find(path.string()); at != why.npos)
      why.replace(at, path.string().size(), path.filename().string());
    return cannot(name, why);
  }
}

}  // namespace kte::view
