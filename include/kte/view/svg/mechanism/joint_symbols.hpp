#pragma once

#include <kte/view/svg/mechanism/scene_view.hpp>
#include <kte/view/svg/mechanism/styles.hpp>

/// Symbols of joints, by kind, in the direction of the view.
namespace kte::detail::svg {

/// A joint in the picture.
struct joint_place {
  vec3<> at;
  vec3<> axis;  ///< of length 1
  std::string name;
};

/// Draws joints with sizes in mm.
class joint_symbols {
 public:
  joint_symbols(const scene_view& view, bool planar, double radius, std::vector<drawn_shape>& out)
      : view_(view), planar_(planar), radius_(radius), out_(out) {}

  void circle(const joint_place& j, double radius, const shape_style& style) {
    out_.push_back({style, j.name, {view_(j.at)}, radius});
  }
  /// A hinge: in the plane a circle, in space a cylinder along the axis.
  void cylinder(const joint_place& j, double half_length) {
    if (planar_) return circle(j, radius_, styles::joint);
    const auto [a, b] = across(j.axis);
    const vec3<> end = mm(half_length) * facing(j.axis);
    const auto ring = [&, a = a, b = b](double from, int quarters, const vec3<>& centre) {
      return ellipse_points<picture_point>(from, quarters, [&](double c, double s) {
        return view_(centre + mm(radius_ * c) * a + mm(radius_ * s) * b);
      });
    };
    // In parallel projection the outline is tangent to the circles at a, which is normal to the axis in the picture.
    auto outline = ring(0, 2, j.at + end);
    const auto back = ring(std::numbers::pi, 2, j.at - end);
    const auto straight_to = [&outline](picture_point p) {
      const auto q = outline.back();
      outline.push_back({q.x + (p.x - q.x) / 3, q.y + (p.y - q.y) / 3});
      outline.push_back({q.x + 2 * (p.x - q.x) / 3, q.y + 2 * (p.y - q.y) / 3});
      outline.push_back(p);
    };
    straight_to(back.front());
    outline.insert(outline.end(), back.begin() + 1, back.end());
    straight_to(outline.front());
    out_.push_back({styles::joint, j.name, std::move(outline), 0, true, true});
    out_.push_back({styles::joint_line, j.name, ring(0, 4, j.at + end), 0, true, true});
  }
  /// A slider: a box along the axis with three visible faces; in the plane with one.
  void box(const joint_place& j, double half_length, double half_width) {
    const auto [a, b] = across(j.axis);
    const vec3<> edges[]{mm(half_width) * facing(b), mm(half_length) * facing(j.axis), mm(half_width) * facing(a)};
    for (std::size_t i = 0; i < (planar_ ? 1 : 3); ++i) {
      const vec3<>&u = edges[(i + 1) % 3], &v = edges[(i + 2) % 3], c = j.at + edges[i];
      out_.push_back(
          {styles::joint, j.name, {view_(c - u - v), view_(c + u - v), view_(c + u + v), view_(c - u + v)}, 0, true});
    }
  }
  void line(const vec3<>& from, const vec3<>& to, const shape_style& style, const std::string& name) {
    out_.push_back({style, name, {view_(from), view_(to)}});
  }
  /// A cross of two directions.
  void cross_of(const joint_place& j) {
    const auto [a, b] = across(j.axis);
    for (const auto& d : {a, b})
      line(j.at - mm(0.75 * radius_) * d, j.at + mm(0.75 * radius_) * d, styles::joint_line, j.name);
  }
  void fixed(const joint_place& j) {
    const auto p = view_(j.at);
    const double r = 0.7 * radius_;
    out_.push_back({styles::full,
                    j.name,
                    {{p.x - r, p.y - r}, {p.x + r, p.y - r}, {p.x + r, p.y + r}, {p.x - r, p.y + r}},
                    0,
                    true});
  }
  double radius() const { return radius_; }

 private:
  double mm(double x) const { return x / view_.scale(); }
  vec3<> facing(const vec3<>& v) const { return dot(v, view_.axes().towards) < 0 ? -v : v; }
  /// Two directions normal to an axis: one in the picture plane, and one that points away from the viewer.
  std::pair<vec3<>, vec3<>> across(const vec3<>& axis) const {
    const auto& seen = view_.axes();
    const vec3<> a = unit_or(cross(axis, seen.towards), unit_or(cross(axis, seen.up), seen.right));
    return {a, -facing(cross(axis, a))};
  }

  const scene_view& view_;
  bool planar_;
  double radius_;
  std::vector<drawn_shape>& out_;
};

}  // namespace kte::detail::svg
