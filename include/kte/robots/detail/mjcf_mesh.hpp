#pragma once

#include <kte/robots/detail/mesh_body.hpp>
#include <kte/robots/detail/mesh_edges.hpp>
#include <kte/robots/detail/mesh_file.hpp>
#include <kte/robots/detail/mesh_fit.hpp>
#include <kte/robots/detail/mjcf_builtin_mesh.hpp>
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
    if (a->has("file")) s.mesh = model.path_of(*a).generic_string();
  }
  /// The body of a mesh geom in the axes of the mesh.
  rigid_body<> body(const xml_item& geom, mjcf_model& model) {
    const auto* const a = needed_asset(geom, model);
    const auto& read_asset = read(geom, model);
    const auto& mesh = read_asset.mesh;
    const auto kind = kind_of(geom, model);
    auto& known = bodies_[{a, kind}];
    if (!known) {
      if ((kind == mesh_inertia::convex || mesh.faces.empty()) && a->whole_or("maxhullvert", -1) >= 0)
        a->moves_differently("its maxhullvert is not read: its mass is that of the whole hull");
      if (!read_asset.edge.empty() && (kind == mesh_inertia::legacy || kind == mesh_inertia::exact))
        a->warn("its surface is not closed, so that its mass may be wrong" +
                std::string(is_asked(*a, model) ? "" : "; the rule 'legacy' is used") + ": " + read_asset.edge);
      guarded(geom, [&] {
        known = mesh_body(mesh, kind, 1);
        if (kind == mesh_inertia::exact && !is_asked(*a, model)) compare(*a, mesh, known->mass);
      });
    }
    const auto& unit = *known;
    const double k = geom.has("mass") ? geom.not_negative("mass") / unit.mass : geom.not_negative_or("density", 1000);
    const auto& i = unit.inertia;
    return {k * unit.mass, unit.com, {k * i.xx, k * i.xy, k * i.xz, k * i.yy, k * i.yz, k * i.zz}};
  }
  /// Sets the pose and sizes of a geom of another form so that it fits its mesh.
  void fit(const xml_item& geom, const mjcf_scope& in, mjcf_geom& g) {
    const auto kind = kind_of(geom, *in.model);
    const auto fitted = guarded(
        geom, [&] { return fit_mesh(read(geom, *in.model).mesh, kind, g.shape.is, in.model->settings.fits_boxes()); });
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
  /// Whether the file chooses among legacy, exact, convex and shell.
  static bool is_asked(const xml_item& asset, const mjcf_model& model) {
    return model.settings.exact_meshes().has_value() || asset.has("inertia");
  }
  /// The mass distribution of a mesh: that of the file, else the enclosed volume, or legacy if the surface is open.
  mesh_inertia kind_of(const xml_item& geom, mjcf_model& model) {
    const auto* a = needed_asset(geom, model);
    if (geom.text_or("shellinertia", "false") == "true") return mesh_inertia::shell;
    if (const auto exact = model.settings.exact_meshes()) return *exact ? mesh_inertia::exact : mesh_inertia::legacy;
    if (!is_asked(*a, model)) return read(geom, model).edge.empty() ? mesh_inertia::exact : mesh_inertia::legacy;
    const auto kind = a->text("inertia");
    static const std::map<std::string, mesh_inertia, std::less<>> kinds{{"legacy", mesh_inertia::legacy},
                                                                        {"exact", mesh_inertia::exact},
                                                                        {"convex", mesh_inertia::convex},
                                                                        {"shell", mesh_inertia::shell}};
    const auto it = kinds.find(kind);
    if (it == kinds.end()) a->fail("inertia '" + excerpt(kind) + "' is none of legacy, exact, convex, shell");
    return it->second;
  }
  /// Warns if other rules for the mass of a mesh give a mass that differs by more than 1 %; for convex ones none does.
  static void compare(const xml_item& asset, const triangle_mesh& mesh, double mass) {
    if (is_convex(mesh)) return;
    const double legacy = moments_of(mesh, mesh_inertia::legacy).amount / mass - 1;
    const double hull = moments_of(mesh, mesh_inertia::convex).amount / mass - 1;
    if (std::abs(legacy) <= 0.01 && std::abs(hull) <= 0.01) return;
    const auto larger = [](double x) { return short_number(100 * x) + " %"; };
    asset.warn(
        "its mass is that of the volume that it encloses; by the rule 'legacy', the default of MuJoCo, it would be " +
        larger(legacy) + " larger, and by its convex hull " + larger(hull) +
        " (choose by inertia=\"exact\", \"legacy\" or \"convex\")");
  }
  /// A mesh, and the edge where its surface is open.
  struct asset_mesh {
    triangle_mesh mesh;
    std::string edge;
  };
  const asset_mesh& read(const xml_item& geom, mjcf_model& model) {
    const auto* a = needed_asset(geom, model);
    if (const auto known = meshes_.find(a); known != meshes_.end()) return known->second;
    triangle_mesh mesh;
    if (a->has("file")) {
      const auto path = model.path_of(*a);
      if (!is_file(path))
        geom.fail("its mass is that of a mesh, and there is no file '" + excerpt(path.generic_string()) + "'");
      model.d.files.push_back(path.string());
      mesh = read_mesh(path);
    } else {
      mesh = written_out(*a);
    }
    const auto turn = a->has("refquat") ? rotation_of_quaternion(*a, a->list("refquat")) : robot_pose{}.rotation;
    mesh = placed_mesh(std::move(mesh), a->vector_or("refpos", {}), turn, a->vector_or("scale", {1, 1, 1}));
    const auto edge = guarded(geom, [&] { return open_edge(mesh); });
    if (!is_asked(*a, model) && edge.empty() && points_inwards(mesh)) {
      a->warn("its faces point inwards; they are taken as pointing outwards");
      for (auto& f : mesh.faces) std::swap(f[1], f[2]);
    }
    return meshes_.emplace(a, asset_mesh{std::move(mesh), edge}).first->second;
  }
  static triangle_mesh written_out(const xml_item& a) {
    triangle_mesh mesh;
    if (a.has("builtin")) return mjcf_builtin_mesh(a);
    if (!a.has("vertex")) a.fail("it has no file and no vertex: the mass of what a plugin makes is not read");
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

  std::map<std::pair<const xml_item*, mesh_inertia>, std::optional<rigid_body<>>> bodies_;  ///< at density 1
  std::map<const mjcf_model*, std::map<std::string, xml_item, std::less<>>> assets_;
  std::map<const xml_item*, asset_mesh> meshes_;
};

}  // namespace kte::detail
