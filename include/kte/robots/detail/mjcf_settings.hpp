#pragma once

#include <kte/robots/detail/read_values.hpp>

#include <deque>
#include <map>

namespace kte::detail {

/// What holds for a whole file in MJCF: the compiler's settings and the classes of defaults.
class mjcf_settings {
 public:
  mjcf_settings(const xml_item& root, robot_description& d, const robot_options& o) : d_(d), options_(o) {
    for (const auto& c : root.children("compiler")) compiler(c);
    for (const auto& x : root.children("default")) add_class(x, "main", {});
  }

  /// The element with the attributes that its class gives it.
  xml_item resolved(const xml_item& x, const std::string& around) {
    const auto name = x.text_or("class", around.empty() ? "main" : around.c_str());
    const auto known = classes_.find(name);
    if (known == classes_.end() && x.has("class")) x.fail("there is no default class '" + excerpt(name) + "'");
    xml_node n = x.node();
    if (known != classes_.end())
      if (const auto of = known->second.find(n.name); of != known->second.end())
        for (const auto& [key, value] : of->second)
          if (!x.has(key.c_str())) n.attributes.emplace_back(key, value);
    return {kept_.emplace_back(std::move(n)), d_};
  }
  bool has_class(const std::string& name) const { return name == "main" || classes_.contains(name); }

  double angle(double x) const { return degrees_ ? x * (std::numbers::pi / 180) : x; }
  bool limits_by_range() const { return auto_limits_; }
  bool always_from_geoms() const { return from_geoms_; }
  const robot_options& options() const { return options_; }

  /// Position, and rotation by quat, axisangle, euler, xyaxes or zaxis.
  robot_pose place(const xml_item& x) const { return {x.vector_or("pos", {}), rotation(x)}; }

 private:
  using attributes = std::map<std::string, std::string, std::less<>>;
  using by_element = std::map<std::string, attributes, std::less<>>;

  void compiler(const xml_item& c) {
    c.only({}, {"angle", "eulerseq", "coordinate", "autolimits", "inertiafromgeom", "meshdir", "texturedir"});
    degrees_ = c.text_or("angle", "degree") == "degree";
    sequence_ = c.text_or("eulerseq", "xyz");
    if (sequence_.size() != 3 || sequence_.find_first_not_of("xyzXYZ") != sequence_.npos)
      c.fail("eulerseq must be three of x, y, z, X, Y, Z, got '" + excerpt(sequence_) + "'");
    if (c.text_or("coordinate", "local") != "local") c.fail("coordinate='global' is not read: only local poses are");
    auto_limits_ = c.text_or("autolimits", "true") == "true";
    from_geoms_ = c.text_or("inertiafromgeom", "auto") == "true";
  }
  void add_class(const xml_item& x, const std::string& fallback, by_element all) {
    const auto name = x.text_or("class", fallback.c_str());
    if (name.empty()) x.fail("has no class");
    for (const auto& c : x.children())
      if (c.name() != "default")
        for (const auto& [key, value] : c.node().attributes) all[std::string(c.name())][key] = value;
    classes_[name] = all;
    for (const auto& c : x.children("default")) add_class(c, "", all);
  }

  mat3<vec3<>> rotation(const xml_item& x) const {
    const double t = options_.quarter_turn_tolerance;
    if (x.has("quat")) return rotation_of_quaternion(x, x.list("quat"));
    if (x.has("euler")) {
      const auto e = x.vector("euler");
      mat3<vec3<>> r{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      for (std::size_t i = 0; i < 3; ++i) {
        const char c = sequence_[i];
        const double a = angle(i == 0 ? e.x : i == 1 ? e.y : e.z);
        note_near_quarter(x, a, options_);
        const auto turn = turn_about((c | 32) - 'x', a, t);
        r = c >= 'x' ? r * turn : turn * r;  // small letters turn with the frame
      }
      return without_minus_zero(r);
    }
    if (x.has("axisangle")) {
      const auto a = x.list("axisangle");
      if (a.size() != 4) x.fail("axisangle must have four numbers, got " + std::to_string(a.size()));
      const auto [c, s] = turn_by(angle(a[3]), t);
      return without_minus_zero(as<double>(rotation_about(unit_axis(x, {a[0], a[1], a[2]}), c, s)));
    }
    if (x.has("xyaxes")) {
      const auto a = x.list("xyaxes");
      if (a.size() != 6) x.fail("xyaxes must have six numbers, got " + std::to_string(a.size()));
      const auto u = unit_axis(x, {a[0], a[1], a[2]});
      const vec3<> v{a[3], a[4], a[5]};
      const auto w = unit_axis(x, v - dot(u, v) * u);
      return without_minus_zero(transpose(mat3<vec3<>>{u, w, cross(u, w)}));
    }
    if (x.has("zaxis")) return shortest_turn_of_z_to(unit_axis(x, x.vector("zaxis")));
    return robot_pose{}.rotation;
  }

  robot_description& d_;
  const robot_options& options_;
  bool degrees_ = true, auto_limits_ = true, from_geoms_ = false;
  std::string sequence_ = "xyz";
  std::map<std::string, by_element, std::less<>> classes_;
  std::deque<xml_node> kept_;
};

}  // namespace kte::detail
