#pragma once

#include <kte/robots/detail/mesh_body.hpp>
#include <kte/robots/detail/mesh_edges.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/mjcf_geom.hpp>

namespace kte::detail {

/// The mesh assets of files in MJCF, each read once, and only if its mass or its size is needed.
class mjcf_meshes {
  /// Calls f; errors name the geom that needs the mesh.
  template <class F>
  static auto guarded(const xml_item& geom, const F& f) {
    try {
      return f();
    } catch (const bad_argument& e) {
      geom.fail("of its mesh '" + excerpt(geom.text("mesh")) + "': " + std::string(e.what()).substr(5));
    }
  }

 public:
  /// Sets the file and scale of a mesh geom, as far as the assets give them.
  void describe(const xml_item& geom, mjcf_model& model, robot_shape& s) {
    const auto* a = asset(model, geom.text("mesh"));
    if (!a) return geom.not_read("there is no mesh '" + excerpt(geom.text("mesh")) + "' among the assets");
    s.scale = a->vector_or("scale", {1, 1, 1});
    for (const char* const reference : {"refpos", "refquat"})
      if (a->has(reference)) geom.not_read(std::string("its shape is without the ") + reference + " of its mesh");
    if (a->has("file")) s.mesh = path_of(*a, model).generic_string();
  }
  /// The body of a mesh geom in the axes of the mesh.
  rigid_body<> body(const xml_item& geom, mjcf_model& model) {
    const auto kind = kind_of(geom, model);
    const auto* const a = needed_asset(geom, model);
    auto& known = bodies_[{a, kind}];
    if (!known) {
      const auto& mesh = read(geom, model);
      if ((kind == mesh_inertia::convex || mesh.faces.empty()) && a->number_or("maxhullvert", -1) >= 0)
        a->moves_differently("its maxhullvert is not read: its mass is that of the whole hull");
      const bool by_volume = kind == mesh_inertia::legacy || kind == mesh_inertia::exact;
      guarded(geom, [&] { known = unit_body{mesh_body(mesh, kind, 1), by_volume ? open_edge(mesh) : std::string()}; });
    }
    const auto& [unit, edge] = *known;
    if (!edge.empty()) geom.warn("its mesh is not closed, so that its mass may be wrong: " + edge);
    const double k = geom.has("mass") ? geom.not_negative("mass") / unit.mass : geom.not_negative_or("density", 1000);
    const auto& i = unit.inertia;
    return {k * unit.mass, unit.com, {k * i.xx, k * i.xy, k * i.xz, k * i.yy, k * i.yz, k * i.zz}};
  }
  /// Sets the pose and sizes of a geom of another form so that it fits its mesh.
  void fit(const xml_item& geom, const mjcf_scope& in, mjcf_geom& g) {
    const auto& mesh = read(geom, *in.model);
    const auto kind = kind_of(geom, *in.model);
    const auto fitted =
        guarded(geom, [&] { return fit_mesh(mesh, kind, g.shape.is, in.model->settings.fits_boxes()); });
    if (in.model->settings.fits_boxes())
      geom.warn("fitaabb: it is placed at its mesh; MuJoCo 2.2.2 places it elsewhere");
    const double k = geom.number_or("fitscale", 1);
    g.half = k * fitted.half, g.shape.origin = in.model->settings.place(geom) * fitted.pose;
  }

 private:
  const xml_item* asset(mjcf_model& model, const std::string& name) {
    auto& all = assets_[&model];
    if (all.empty())
      for (const auto& a : xml_item(model.root, model.d).children("asset"))
        for (const auto& written : a.children("mesh")) {
          const auto m = model.settings.classes().resolved(written, "");
          const auto stem = std::filesystem::path(m.text_or("file", "")).stem().string();
          all.emplace(m.text_or("name", stem.c_str()), m);
        }
    const auto it = all.find(name);
    return it == all.end() ? nullptr : &it->second;
  }
  const xml_item* needed_asset(const xml_item& geom, mjcf_model& model) {
    const auto* const a = asset(model, geom.text("mesh"));
    if (!a) geom.fail("there is no mesh '" + excerpt(geom.text("mesh")) + "' among the assets");
    return a;
  }
  static std::filesystem::path path_of(const xml_item& asset, const mjcf_model& model) {
    const auto file = path_of_text(asset.text("file"));
    return model.folder / path_of_text(model.settings.mesh_folder()) /
           (model.settings.strips_paths() ? file.filename() : file);
  }
  mesh_inertia kind_of(const xml_item& geom, mjcf_model& model) {
    const auto* a = needed_asset(geom, model);
    if (geom.text_or("shellinertia", "false") == "true") return mesh_inertia::shell;
    if (model.settings.exact_meshes()) return mesh_inertia::exact;
    const auto kind = a->text_or("inertia", "legacy");
    static const std::map<std::string, mesh_inertia, std::less<>> kinds{{"legacy", mesh_inertia::legacy},
                                                                        {"exact", mesh_inertia::exact},
                                                                        {"convex", mesh_inertia::convex},
                                                                        {"shell", mesh_inertia::shell}};
    const auto it = kinds.find(kind);
    if (it == kinds.end()) a->fail("inertia '" + excerpt(kind) + "' is none of legacy, exact, convex, shell");
    return it->second;
  }
  const triangle_mesh& read(const xml_item& geom, mjcf_model& model) {
    const auto* a = needed_asset(geom, model);
    if (const auto known = meshes_.find(a); known != meshes_.end()) return known->second;
    triangle_mesh mesh;
    if (a->has("file")) {
      const auto path = path_of(*a, model);
      if (!is_file(path))
        geom.fail("its mass is that of a mesh, and there is no file '" + excerpt(path.generic_string()) + "'");
      mesh = read_mesh(path);
    } else {
      mesh = written_out(*a);
    }
    const auto turn = a->has("refquat") ? rotation_of_quaternion(*a, a->list("refquat")) : robot_pose{}.rotation;
    mesh = placed_mesh(std::move(mesh), a->vector_or("refpos", {}), turn, a->vector_or("scale", {1, 1, 1}));
    return meshes_.emplace(a, std::move(mesh)).first->second;
  }
  static triangle_mesh written_out(const xml_item& a) {
    triangle_mesh mesh;
    if (!a.has("vertex"))
      a.fail("it has no file and no vertex: the mass of what a plugin or a builtin makes is not read");
    const auto v = a.list("vertex");
    if (v.size() % 3 != 0) a.fail("vertex must have three numbers per vertex, got " + std::to_string(v.size()));
    for (std::size_t i = 0; i < v.size(); i += 3) mesh.vertices.push_back({v[i], v[i + 1], v[i + 2]});
    if (!a.has("face")) return mesh;
    const auto f = a.list("face");
    if (f.size() % 3 != 0) a.fail("face must have three numbers per face, got " + std::to_string(f.size()));
    for (std::size_t i = 0; i < f.size(); i += 3) {
      auto& face = mesh.faces.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (!(f[i + k] >= 0 && f[i + k] < static_cast<double>(mesh.vertices.size())) ||
            f[i + k] != std::floor(f[i + k]))
          a.fail("face names vertex " + number(f[i + k]) + " of " + std::to_string(mesh.vertices.size()));
        face[k] = static_cast<std::uint32_t>(f[i + k]);
      }
    }
    return mesh;
  }

  /// The body at density 1, and the edge where its surface is open.
  struct unit_body {
    rigid_body<> body;
    std::string edge;
  };
  std::map<std::pair<const xml_item*, mesh_inertia>, std::optional<unit_body>> bodies_;
  std::map<const mjcf_model*, std::map<std::string, xml_item, std::less<>>> assets_;
  std::map<const xml_item*, triangle_mesh> meshes_;
};

}  // namespace kte::detail
