#pragma once

#include <kte/view/svg/mechanism/body_symbol.hpp>
#include <kte/view/svg/mechanism/force_symbols.hpp>
#include <kte/view/svg/mechanism/joint_symbols.hpp>
#include <kte/view/svg/mechanism/options.hpp>

/// A mechanism in one position as lines and areas; the list of shapes is the same at all times.
namespace kte::detail::svg {

class mechanism_shapes {
 public:
  mechanism_shapes(const scene& s, const scene_view& view, const picture_options& o) : scene_(s), view_(view), o_(o) {}

  std::vector<drawn_shape> at(const std::vector<placed_frame>& frames) const {
    std::vector<drawn_shape> out;
    if (o_.bodies)
      for (const auto& b : scene_.bodies)
        if (b.mass > 0) put_body(out, b, frames[index(b.frame)]);
    for (const auto& l : scene_.links) put_link(out, frames[index(l.from)], frames[index(l.to)], styles::link, l.type);
    for (const auto& j : scene_.joints) put_placement(out, j, frames);
    for (const auto& f : scene_.forces) put_force(out, f, frames);
    if (o_.joints)
      for (const auto& j : scene_.joints) put_joint(out, j, frames);
    return out;
  }
  /// Types of parts of the scene without a symbol.
  std::vector<std::string> left_out() const {
    std::vector<std::string> all;
    for (const auto& f : scene_.forces)
      if (!has_symbol(f)) all.push_back(f.type + (f.name.empty() ? "" : " '" + f.name + "'"));
    const auto of_file =
        std::count_if(scene_.shapes.begin(), scene_.shapes.end(), [](const auto& x) { return !x.contact; });
    if (of_file > 0) all.push_back(std::to_string(of_file) + " shapes of the robot's file");
    return all;
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static vec3<> vector(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }
  static bool apart(picture_point a, picture_point b) { return std::hypot(a.x - b.x, a.y - b.y) > 0.01; }
  static std::string named(const std::string& type, const std::string& name) {
    return name.empty() ? type : name + " (" + type + ")";
  }
  /// The joint of the coordinate on which a spring acts, or nullptr.
  const scene::joint* joint_of(const scene::force& f) const {
    if (f.kind != "spring" || !f.frames.empty() || f.coordinates.size() != 1) return nullptr;
    for (const auto& j : scene_.joints)
      if ((j.kind == "revolute" || j.kind == "prismatic") && j.coordinates == f.coordinates) return &j;
    return nullptr;
  }
  bool has_symbol(const scene::force& f) const {
    if (f.kind == "torsion_spring") return !f.frames.empty();
    if (f.type.starts_with("torsion_") || f.kind == "contact") return false;
    return f.frames.size() >= 2 || joint_of(f) != nullptr;
  }

  void put_link(std::vector<drawn_shape>& out, const placed_frame& a, const placed_frame& b, const shape_style& style,
                const std::string& name) const {
    out.push_back({style, name, {view_(a.position), view_(b.position)}});
  }
  /// The ellipsoid of a body, and a line to it from its frame if that is elsewhere.
  void put_body(std::vector<drawn_shape>& out, const scene::body& b, const placed_frame& f) const {
    const std::string name = named(four_digits(b.mass) + " kg", b.name);
    out.push_back(body_symbol(view_, b, f, 0.8 * o_.joint_radius, name));
    if (length(vector(b.centre)) > 0)
      out.push_back({styles::link, name, {view_(f.position), view_(f(vector(b.centre)))}});
  }
  /// A line from the frame before a joint to its placement; for sliders the rail.
  void put_placement(std::vector<drawn_shape>& out, const scene::joint& j,
                     const std::vector<placed_frame>& frames) const {
    if (j.kind == "free") return;
    const auto &a = frames[index(j.before)], &b = frames[index(j.after)];
    const bool slides = j.has_axis && (j.kind == "prismatic" || j.kind == "cylindrical" || j.kind == "screw");
    const bool moves = j.kind == "planar" || j.kind == "other";  // relative motion; recordings are rounded
    const double least = 1e-3 * scene_.size;
    if (!slides) {
      if (moves || length(b.position - a.position) > least) put_link(out, a, b, styles::placement, j.name);
      return;
    }
    const vec3<> axis = a.rotation * vector(j.axis), placement = b.position - dot(b.position - a.position, axis) * axis;
    const bool known = std::isfinite(j.lower) && std::isfinite(j.upper) && j.kind == "prismatic";
    const double reach = 3 * o_.joint_radius / view_.scale(), now = dot(b.position - a.position, axis);
    const double low = known ? j.lower : (std::min)(now - reach, 0.0),
                 high = known ? j.upper : (std::max)(now + reach, 0.0);
    out.push_back({styles::rail, j.name, {view_(placement + low * axis), view_(placement + high * axis)}});
    if (length(placement - a.position) > least)
      out.push_back({styles::placement, j.name, {view_(a.position), view_(placement)}});
  }
  void put_joint(std::vector<drawn_shape>& out, const scene::joint& j, const std::vector<placed_frame>& frames) const {
    const double r = o_.joint_radius;
    joint_symbols symbols(view_, scene_.dimension == 2, r, out);
    const vec3<> axis =
        j.has_axis ? unit_or(frames[index(j.before)].rotation * vector(j.axis), {0, 0, 1}) : vec3<>{0, 0, 1};
    const joint_place place{frames[index(j.after)].position, axis, named(j.type, j.name)};
    const bool in_axis = j.kind != "revolute" || scene_.dimension == 3;
    if (j.kind == "free") return;
    if (j.kind == "revolute" && in_axis)
      symbols.cylinder(place, 1.2 * r);
    else if (j.kind == "revolute")
      symbols.circle(place, r, styles::joint);
    else if (j.kind == "prismatic")
      symbols.box(place, 1.7 * r, r);
    else if (j.kind == "cylindrical" || j.kind == "screw")
      symbols.box(place, 1.9 * r, r), symbols.cylinder(place, 2.2 * r);
    else if (j.kind == "spherical")
      symbols.circle(place, r, styles::joint), symbols.circle(place, 0.6 * r, styles::full);
    else if (j.kind == "universal")
      symbols.circle(place, r, styles::joint), symbols.cross_of(place);
    else if (j.kind == "planar")
      symbols.box(place, 0.4 * r, 1.8 * r);
    else if (j.kind == "fixed")
      symbols.fixed(place);
    else
      symbols.circle(place, r, styles::joint), symbols.circle(place, 0.3 * r, styles::full);
  }
  void put_force(std::vector<drawn_shape>& out, const scene::force& f, const std::vector<placed_frame>& frames) const {
    if (!has_symbol(f)) return;
    const std::string name = named(f.type, f.name);
    const auto* const joint = joint_of(f);
    const auto& a = frames[index(joint != nullptr ? joint->before : f.frames[0])];
    const auto& b = frames[index(joint != nullptr ? joint->after : f.frames.back())];
    const auto from = view_(a.position), to = view_(b.position);
    const double r = o_.joint_radius;
    if (f.kind == "torsion_spring" || (joint != nullptr && joint->kind == "revolute")) {
      out.push_back(spiral_symbol(to, 1.2 * r, name));
    } else if (f.kind == "spring") {
      out.push_back(spring_symbol(from, to, 0.9 * r, name));
    } else if (f.kind == "damper") {
      for (auto& s : damper_symbol(from, to, 0.8 * r, name)) out.push_back(std::move(s));
    } else if (f.kind == "beam") {
      const vec3<> chord = unit_or(b.position - a.position, {1, 0, 0}), x{1, 0, 0};
      const bool bends = f.type.starts_with("flexible_beam");
      out.push_back(beam_symbol(view_, a, b, bends ? x : transpose(a.rotation) * chord,
                                bends ? x : transpose(b.rotation) * chord, name));
    } else {
      out.push_back({styles::loop, name, {from, to}});
    }
  }

  const scene& scene_;
  const scene_view& view_;
  const picture_options& o_;
};

}  // namespace kte::detail::svg
