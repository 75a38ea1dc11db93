#pragma once

#include <kte/robots/detail/angles.hpp>
#include <kte/robots/detail/free_names.hpp>
#include <kte/robots/detail/shape_names.hpp>
#include <kte/robots/detail/unwritten.hpp>
#include <kte/robots/detail/xml_writer.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

namespace kte::detail {

inline void write_mjcf_place(xml_writer& out, const robot_pose& p) {
  if (p.position != vec3<>{}) out.attribute("pos", p.position);
  if (p.rotation == robot_pose{}.rotation) return;
  const auto q = to_quaternion(p.rotation);
  out.attribute("quat", std::vector<double>{q.w, q.x, q.y, q.z});
}

/// Writes shapes as massless geoms. A shape that is both visual and collision becomes one geom of group 0; visual
/// shapes have group 2, collision shapes group 3.
class mjcf_geoms {
 public:
  mjcf_geoms(const robot_description& d, const robot_writing& o, unwritten& left_out)
      : o_(o), left_out_(left_out), names_of_shapes_(d), of_link_(d.links.size()) {
    for (std::size_t i = 0; i < d.links.size(); ++i) {
      const auto& l = d.links[i];
      std::vector<const robot_shape*> rest;
      for (const auto& c : l.collisions) rest.push_back(&c);
      for (const auto& v : l.visuals) {
        const auto twin = std::find_if(rest.begin(), rest.end(), [&](const auto* c) { return is_twin(v, *c); });
        add(i, l, v, true, twin != rest.end());
        if (twin != rest.end()) rest.erase(twin);
      }
      for (const auto* c : rest) add(i, l, *c, false, true);
    }
  }

  void write_assets(xml_writer& out) const {
    if (meshes_.empty() && materials_.empty()) return;
    out.open("asset");
    for (const auto& m : meshes_) {
      out.open("mesh"), out.attribute("name", std::string_view(m.name)),
          out.attribute("file", std::string_view(m.path));
      if (m.scale != vec3<>{1, 1, 1}) out.attribute("scale", m.scale);
      out.close();
    }
    for (const auto& [name, s] : materials_) {
      out.open("material"), out.attribute("name", std::string_view(name));
      if (const auto rgba = colour_of(*s); !rgba.empty()) out.attribute("rgba", rgba);
      out.close();
    }
    out.close();
  }
  bool has_mesh(std::size_t link) const {
    for (const auto& g : of_link_[link])
      if (g.shape->is == form::mesh) return true;
    return false;
  }
  void write(xml_writer& out, std::size_t link, bool at_rest) {
    for (const auto& g : of_link_[link]) {
      const auto& s = *g.shape;
      if (s.is == form::plane && !at_rest) {
        leave_out(s, g.owner, "it is a plane, which MuJoCo accepts only on static bodies");
        continue;
      }
      out.open("geom");
      if (!g.name.empty()) out.attribute("name", std::string_view(g.name));
      static constexpr std::string_view types[]{"",       "box",       "cylinder", "capsule",
                                                "sphere", "ellipsoid", "plane",    "mesh"};
      out.attribute("type", types[static_cast<std::size_t>(s.is)]);
      write_mjcf_place(out, s.origin);
      if (s.is == form::mesh)
        out.attribute("mesh", std::string_view(g.mesh));
      else
        out.attribute("size", mjcf_size(s));
      if (!g.collides) out.attribute("contype", 0.0), out.attribute("conaffinity", 0.0);
      if (!g.seen || !g.collides) out.attribute("group", g.seen ? 2.0 : 3.0);
      if (!s.material.empty()) out.attribute("material", std::string_view(s.material));
      if (const auto rgba = colour_of(s); !rgba.empty()) out.attribute("rgba", rgba);
      out.attribute("mass", 0.0), out.close();
    }
  }

 private:
  using form = robot_shape::form;
  struct geom {
    const robot_shape* shape;
    std::string name, owner;
    bool seen, collides;
    std::string mesh;
  };
  struct asset {
    std::string name, path;
    vec3<> scale;
  };

  static bool is_twin(const robot_shape& a, const robot_shape& b) {
    return a.name == b.name && a.origin == b.origin && a.is == b.is && a.size == b.size && a.mesh == b.mesh &&
           a.scale == b.scale;
  }
  static std::vector<double> mjcf_size(const robot_shape& s) {
    const auto& x = s.size;
    if (s.is == form::sphere) return {x.x};
    if (s.is == form::box) return {x.x / 2, x.y / 2, x.z / 2};
    if (s.is == form::cylinder || s.is == form::capsule) return {x.x, x.y / 2};
    if (s.is == form::plane && !(x.x >= 0 && x.y >= 0 && x.z > 0)) return {0, 0, 1};  // infinite
    return {x.x, x.y, x.z};
  }
  void leave_out(const robot_shape& s, const std::string& owner, const std::string& why) {
    left_out_.list(s.line, owner + ": its " + names_of_shapes_.of(s) + " is left out: " + why);
  }

  void add(std::size_t link, const robot_link& l, const robot_shape& s, bool seen, bool collides) {
    geom g{&s, s.name, "link '" + l.name + "'", seen, collides, {}};
    if (s.is == form::none || s.is == form::height_field)
      return leave_out(s, g.owner, s.is == form::none ? "its form is not known" : "it is a height field");
    if (s.is == form::mesh && !find_mesh(s, g)) return;
    if (s.is != form::mesh)
      for (const double x : mjcf_size(s))
        if (s.is != form::plane && !(x > 0)) return leave_out(s, g.owner, "MuJoCo does not accept a size of 0");
    if (!g.name.empty() && !names_.insert(g.name).second) {
      left_out_.list(s.line, g.owner + ": the name '" + g.name + "' of a shape occurs twice, and is omitted");
      g.name.clear();
    }
    if (!s.material.empty()) materials_.emplace(s.material, &s);
    of_link_[link].push_back(std::move(g));
  }
  bool find_mesh(const robot_shape& s, geom& g) {
    auto path = o_.mesh_path && !s.mesh.empty() ? o_.mesh_path(s.mesh) : s.mesh;
    std::string ending = path.substr(path.size() - (std::min<std::size_t>)(path.size(), 4));
    for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (path.empty()) return leave_out(s, g.owner, "its mesh '" + s.mesh + "' has no file"), false;
    if (path.find("://") != path.npos)
      return leave_out(s, g.owner, "MuJoCo accepts paths of meshes, not '" + path + "'"), false;
    if (ending != ".stl" && ending != ".obj" && ending != ".msh")
      return leave_out(s, g.owner, "MuJoCo reads stl, obj and msh, not '" + path + "'"), false;
    if (!o_.mesh_path) {
      if (!std::filesystem::exists(path)) return leave_out(s, g.owner, "there is no file '" + path + "'"), false;
      path = std::filesystem::absolute(path).lexically_normal().generic_string();
    }
    auto& name = known_meshes_[{path, s.scale.x, s.scale.y, s.scale.z}];
    if (name.empty()) {
      name = mesh_names_.fresh(std::filesystem::path(path).filename().string());
      meshes_.push_back({name, path, s.scale});
    }
    g.mesh = name;
    return true;
  }

  const robot_writing& o_;
  unwritten& left_out_;
  shape_names names_of_shapes_;
  std::vector<std::vector<geom>> of_link_;
  std::vector<asset> meshes_;
  std::map<std::string, const robot_shape*, std::less<>> materials_;
  std::set<std::string, std::less<>> names_;
  std::map<std::tuple<std::string, double, double, double>, std::string> known_meshes_;  ///< names by path and scale
  free_names mesh_names_;
};

}  // namespace kte::detail
