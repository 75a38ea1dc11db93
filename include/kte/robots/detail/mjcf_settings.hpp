#pragma once

#include <kte/robots/detail/mjcf_classes.hpp>
#include <kte/robots/detail/read_values.hpp>

#include <array>

namespace kte::detail {

/// The rules of <compiler> for masses, applied after the bodies are read.
struct mjcf_mass_rules {
  double least_mass = 0, least_moment = 0;  ///< boundmass, boundinertia
  double total = -1;                        ///< settotalmass; negative: none
  bool balance = false;                     ///< balanceinertia
  bool fuse = false;                        ///< fusestatic: static bodies are merged
  bool any() const { return least_mass > 0 || least_moment > 0 || total > 0; }
};

/// Rejects elements that write an orientation in several ways, as MuJoCo does; fullinertia counts as an orientation.
inline void check_orientations(const xml_item& x) {
  constexpr std::array<std::string_view, 6> ways{"quat", "axisangle", "euler", "xyaxes", "zaxis", "fullinertia"};
  auto first = ways.size();
  for (const auto& [key, value] : x.node().attributes) {
    const auto way = static_cast<std::size_t>(std::find(ways.begin(), ways.end(), key) - ways.begin());
    if (way == ways.size() || value.empty()) continue;
    if (first != ways.size())
      x.fail("has both " + std::string(ways[(std::min)(first, way)]) + " and " +
             std::string(ways[(std::max)(first, way)]) + ": only one may give its orientation");
    first = way;
  }
  for (const auto& c : x.children()) check_orientations(c);
}

/// The settings of a file in MJCF: those of the compiler and the classes of defaults. Several <compiler> elements act
/// as one; the last value of a repeated attribute is used.
class mjcf_settings {
 public:
  mjcf_settings(const xml_item& root, const robot_options& o) : options_(o), classes_(root) {
    for (const auto& c : root.children("compiler")) compiler(c);
  }

  const mjcf_classes& classes() const { return classes_; }
  double angle(double x) const { return degrees_ ? x * (std::numbers::pi / 180) : x; }
  bool limits_by_range() const { return auto_limits_; }
  /// Whether the mass of a body comes from its geoms.
  bool from_geoms(bool has_inertial) const { return from_geoms_ == "auto" ? !has_inertial : from_geoms_ == "true"; }
  /// Whether geoms of a group contribute to masses.
  bool counts(double group) const { return group >= groups_[0] && group <= groups_[1]; }
  const mjcf_mass_rules& masses() const { return masses_; }
  /// Whether poses are in the axes of the world (coordinate="global").
  bool in_world() const { return in_world_; }
  const std::string& mesh_folder() const { return mesh_folder_.empty() ? asset_folder_ : mesh_folder_; }
  bool strips_paths() const { return strip_path_; }
  /// Whether the inertia of meshes is exact or legacy, if the file says so.
  std::optional<bool> exact_meshes() const { return exact_meshes_; }
  bool fits_boxes() const { return fit_boxes_; }
  /// Whether geoms that do not collide are discarded.
  bool discards_visuals() const { return discard_; }
  const robot_options& options() const { return options_; }

  /// The pose of an element: pos, and the rotation by quat, axisangle, euler, xyaxes or zaxis.
  robot_pose place(const xml_item& x) const { return {x.vector_or("pos", {}), rotation(x)}; }
  /// The rotation of three Euler angles in the order of eulerseq.
  mat3<vec3<>> rotation_of_euler(const xml_item& x, const vec3<>& e) const {
    mat3<vec3<>> r{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
      const char c = sequence_[i];
      const double a = angle(i == 0 ? e.x : i == 1 ? e.y : e.z);
      note_near_quarter(x, a, options_);
      const auto turn = turn_about((c | 32) - 'x', a, options_.quarter_turn_tolerance);
      r = c >= 'x' ? r * turn : turn * r;  // lower case: about axes that turn with the frame
    }
    return without_minus_zero(r);
  }

 private:
  void compiler(const xml_item& c) {
    c.only({}, {"angle", "eulerseq", "coordinate", "autolimits", "inertiafromgeom", "meshdir", "assetdir", "strippath",
                "settotalmass", "balanceinertia", "boundmass", "boundinertia", "inertiagrouprange", "exactmeshinertia",
                "fitaabb", "discardvisual", "fusestatic", "alignfree"});
    const auto truth = [&](const char* name, bool& value) {
      if (c.has(name)) value = keyword(c, name, {"false", "true"}) == "true";
    };
    if (c.has("angle")) degrees_ = keyword(c, "angle", {"degree", "radian"}) == "degree";
    if (c.has("eulerseq")) sequence_ = c.text("eulerseq");
    if (sequence_.size() != 3 || sequence_.find_first_not_of("xyzXYZ") != sequence_.npos)
      c.fail("eulerseq must be three of x, y, z, X, Y, Z, got '" + excerpt(sequence_) + "'");
    if (c.has("coordinate")) in_world_ = keyword(c, "coordinate", {"local", "global"}) == "global";
    if (c.text_or("alignfree", "false") == "true")
      c.warn("alignfree is not read: coordinates of free bodies are in the axes of the body");
    if (c.has("inertiafromgeom")) from_geoms_ = keyword(c, "inertiafromgeom", {"auto", "true", "false"});
    truth("autolimits", auto_limits_), truth("strippath", strip_path_), truth("balanceinertia", masses_.balance);
    if (c.has("exactmeshinertia")) truth("exactmeshinertia", exact_meshes_.emplace());
    truth("fitaabb", fit_boxes_);
    truth("fusestatic", masses_.fuse), truth("discardvisual", discard_);
    mesh_folder_ = c.text_or("meshdir", mesh_folder_.c_str());
    asset_folder_ = c.text_or("assetdir", asset_folder_.c_str());
    masses_.least_mass = c.not_negative_or("boundmass", masses_.least_mass);
    masses_.least_moment = c.not_negative_or("boundinertia", masses_.least_moment);
    masses_.total = c.number_or("settotalmass", masses_.total);
    if (!c.has("inertiagrouprange")) return;
    groups_ = c.list("inertiagrouprange");
    if (groups_.size() != 2) c.fail("inertiagrouprange must have two numbers, got " + std::to_string(groups_.size()));
    for (const double n : groups_) c.whole(n, "inertiagrouprange", -2147483648.0, 2147483647.0);
  }

  /// The rotation of an element. If the element has one of these attributes and its class another, the first in this
  /// order is used, as in MuJoCo.
  mat3<vec3<>> rotation(const xml_item& x) const {
    if (x.has("euler")) return rotation_of_euler(x, x.vector("euler"));
    if (x.has("zaxis")) return shortest_turn_of_z_to(unit_direction(x, x.vector("zaxis")));
    if (x.has("xyaxes")) {
      const auto a = x.list("xyaxes");
      if (a.size() != 6) x.fail("xyaxes must have six numbers, got " + std::to_string(a.size()));
      const auto u = unit_direction(x, {a[0], a[1], a[2]});
      const vec3<> v{a[3], a[4], a[5]};
      const auto w = unit_direction(x, v - dot(u, v) * u);
      return without_minus_zero(transpose(mat3<vec3<>>{u, w, cross(u, w)}));
    }
    if (x.has("axisangle")) {
      const auto a = x.list("axisangle");
      if (a.size() != 4) x.fail("axisangle must have four numbers, got " + std::to_string(a.size()));
      const auto [c, s] = turn_by(angle(a[3]), options_.quarter_turn_tolerance);
      return without_minus_zero(as<double>(rotation_about(unit_direction(x, {a[0], a[1], a[2]}), c, s)));
    }
    if (!x.has("quat")) return robot_pose{}.rotation;
    const auto q = x.list("quat");
    if (q == std::vector<double>(4))
      return x.warn("a quaternion of length 0 is taken as no rotation"), robot_pose{}.rotation;
    return rotation_of_quaternion(x, q);
  }

  const robot_options& options_;
  mjcf_classes classes_;
  bool degrees_ = true, auto_limits_ = true, strip_path_ = false, fit_boxes_ = false;
  bool in_world_ = false, discard_ = false;
  std::optional<bool> exact_meshes_;
  std::string from_geoms_ = "auto", sequence_ = "xyz", mesh_folder_, asset_folder_;
  std::vector<double> groups_{-1e9, 1e9};
  mjcf_mass_rules masses_;
};

}  // namespace kte::detail
