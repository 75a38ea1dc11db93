#pragma once

#include <kte/robots/detail/contact_notes.hpp>
#include <kte/robots/detail/file_places.hpp>
#include <kte/robots/detail/lowest_vertices.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/touching_parts.hpp>
#include <kte/robots/options.hpp>

#include <filesystem>

namespace kte::detail {

/// A foot whose shapes are meshes: the points by which it touches the ground, in axes of a link.
struct mesh_foot {
  const robot_link* link = nullptr;  ///< none if no mesh is read
  const robot_shape* shape = nullptr;
  std::vector<touching_part> parts{};
};
/// A mesh of a link, and its pose in the ground in the neutral configuration.
struct standing_mesh {
  const robot_link* link;
  const robot_shape* shape;
  robot_pose link_pose;
};

/// Finds the lowest vertices of meshes in the neutral configuration.
class robot_feet {
 public:
  robot_feet(const robot_description& d, const robot_options& o, contact_notes& notes) : d_(d), o_(o), notes_(notes) {}

  /// `normal`: that of the ground.
  mesh_foot find(const std::vector<standing_mesh>& meshes, const vec3<>& normal) {
    std::vector<vec3<>> all;
    const standing_mesh* lowest = nullptr;
    double height = std::numeric_limits<double>::infinity();
    for (const auto& m : meshes)
      for (const auto& v : vertices(m)) {
        all.push_back(in(m.link_pose, in(m.shape->origin, v)));
        if (const double h = dot(normal, all.back()); h < height) height = h, lowest = &m;
      }
    if (lowest == nullptr) return {};
    mesh_foot foot{lowest->link, lowest->shape};
    const auto back = inverse_of(lowest->link_pose);
    for (const auto& p : lowest_vertices(all, normal))
      foot.parts.push_back({"/point " + std::to_string(foot.parts.size() + 1), in(back, p)});
    notes_.add("it touches by the lowest vertices of its mesh in the neutral configuration", *lowest->link,
               *lowest->shape);
    return foot;
  }

 private:
  static vec3<> in(const robot_pose& x, const vec3<>& p) { return as<double>(x.position + x.rotation * p); }

  /// The vertices of a mesh, scaled; none, with a warning, if its file is not read.
  std::vector<vec3<>> vertices(const standing_mesh& m) {
    const auto& s = *m.shape;
    const auto file = find_mesh_file(s.mesh, std::filesystem::path(d_.source).parent_path(), o_.search_path);
    if (s.mesh.empty() || file.empty()) {
      notes_.add("without contact, because the mesh is not found", *m.link, s);
      return {};
    }
    try {
      auto all = read_mesh(file).vertices;
      for (auto& v : all) v = {v.x * s.scale.x, v.y * s.scale.y, v.z * s.scale.z};
      return all;
    } catch (const bad_file& e) {
      notes_.add("without contact: " + std::string(e.what()).substr(5), *m.link, s);
      return {};
    }
  }

  const robot_description& d_;
  const robot_options& o_;
  contact_notes& notes_;
};

}  // namespace kte::detail
