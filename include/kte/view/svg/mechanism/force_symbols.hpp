#pragma once

#include <kte/view/svg/mechanism/scene_motion.hpp>
#include <kte/view/svg/mechanism/scene_view.hpp>
#include <kte/view/svg/mechanism/styles.hpp>

/// Symbols of elements between frames, in mm of the picture.
namespace kte::detail::svg {

/// A line between two points, with its normal direction.
class symbol_line {
 public:
  symbol_line(picture_point from, picture_point to) : from_(from), x_(to.x - from.x), y_(to.y - from.y) {
    const double n = std::hypot(x_, y_);
    across_ = n > 1e-6 ? picture_point{-y_ / n, x_ / n} : picture_point{0, 1};
    length_ = n;
  }
  double length() const { return length_; }
  /// The point at a fraction of the line, and mm to its side.
  picture_point operator()(double part, double beside) const {
    return {from_.x + part * x_ + beside * across_.x, from_.y + part * y_ + beside * across_.y};
  }

 private:
  picture_point from_;
  double x_, y_, length_;
  picture_point across_;
};

/// A zigzag whose straight ends have a sixth of its length each.
inline drawn_shape spring_symbol(picture_point from, picture_point to, double half_width, const std::string& name) {
  const symbol_line line(from, to);
  std::vector<picture_point> points{line(0, 0), line(1.0 / 6, 0)};
  constexpr int turns = 10;
  for (int i = 0; i < turns; ++i)
    points.push_back(line(1.0 / 6 + (i + 0.5) / turns * 2 / 3, i % 2 == 0 ? half_width : -half_width));
  points.push_back(line(5.0 / 6, 0)), points.push_back(line(1, 0));
  return {styles::spring, name, std::move(points)};
}
/// A piston in the middle, in a cylinder with one open end.
inline std::vector<drawn_shape> damper_symbol(picture_point from, picture_point to, double half_width,
                                              const std::string& name) {
  const symbol_line line(from, to);
  const double half = line.length() > 0 ? (std::min)(0.2, 2.5 * half_width / line.length()) : 0.2;
  const double bottom = 0.5 - half, top = 0.5 + half, piston = 0.5 + 0.2 * half, inside = 0.75 * half_width;
  return {{styles::damper, name, {line(0, 0), line(bottom, 0)}},
          {styles::damper,
           name,
           {line(top, half_width), line(bottom, half_width), line(bottom, -half_width), line(top, -half_width)}},
          {styles::damper, name, {line(piston, inside), line(piston, -inside)}},
          {styles::damper, name, {line(piston, 0), line(1, 0)}}};
}
/// A spiral around a joint.
inline drawn_shape spiral_symbol(picture_point centre, double radius, const std::string& name) {
  std::vector<picture_point> points;
  for (int i = 0; i <= 32; ++i) {
    const double u = i * std::numbers::pi / 8, r = radius * (1 + 0.9 * i / 32);
    points.push_back({centre.x + r * std::cos(u), centre.y + r * std::sin(u)});
  }
  return {styles::spring, name, std::move(points)};
}
/// A beam: the cubic that is tangent to the axis of the beam in both frames.
inline drawn_shape beam_symbol(const scene_view& view, const placed_frame& a, const placed_frame& b, const vec3<>& in_a,
                               const vec3<>& in_b, const std::string& name) {
  const double third = length(b.position - a.position) / 3;
  const vec3<> along_a = a.rotation * in_a, along_b = b.rotation * in_b;
  return {styles::beam,
          name,
          {view(a.position), view(a.position + third * along_a), view(b.position - third * along_b), view(b.position)},
          0,
          false,
          true};
}

}  // namespace kte::detail::svg
