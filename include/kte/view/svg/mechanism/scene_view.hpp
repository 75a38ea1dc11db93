#pragma once

#include <kte/math/vec.hpp>
#include <kte/view/scene.hpp>
#include <kte/view/svg/path_data.hpp>

namespace kte::detail::svg {

inline double length(const vec3<>& v) { return std::sqrt(dot(v, v)); }
/// A vector normalized to length 1, or another vector if it is zero.
inline vec3<> unit_or(const vec3<>& v, const vec3<>& other) {
  const double n = length(v);
  return n > 1e-12 ? (1 / n) * v : other;
}

/// The parallel projection of the world: up is against gravity.
struct view_axes {
  vec3<> right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};

  /// Planar scenes are viewed from +z with y upwards.
  view_axes(const scene& s, const std::array<double, 3>& look_from) {
    if (s.dimension == 2) return;
    const vec3<> against = unit_or(vec3{-s.gravity[0], -s.gravity[1], -s.gravity[2]}, {0, 0, 1});
    towards = unit_or({look_from[0], look_from[1], look_from[2]}, {0, -1, 0});
    const vec3<> other = std::abs(against.x) < 0.9 ? vec3<>{1, 0, 0} : vec3<>{0, 1, 0};
    right = unit_or(cross(against, towards), unit_or(cross(cross(towards, other), towards), other));
    up = cross(towards, right);
  }
};

/// A box around points.
struct picture_box {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  void add(double x, double y) {
    left = (std::min)(left, x), right = (std::max)(right, x), low = (std::min)(low, y), high = (std::max)(high, y);
  }
};

/// Maps points of the world, m, to a picture, mm.
class scene_view {
 public:
  explicit scene_view(const view_axes& axes) : axes_(axes) {}

  const view_axes& axes() const { return axes_; }
  /// Sets the scale, and the point of the world, in axes of the view, that is shown at a point of the picture.
  void set(double scale, double x, double y, picture_point at) {
    scale_ = scale, x_ = at.x - scale * x, y_ = at.y + scale * y;
  }
  /// mm per m.
  double scale() const { return scale_; }
  double across(const vec3<>& p) const { return dot(axes_.right, p); }
  double upwards(const vec3<>& p) const { return dot(axes_.up, p); }
  picture_point operator()(const vec3<>& p) const { return {x_ + scale_ * across(p), y_ - scale_ * upwards(p)}; }

 private:
  view_axes axes_;
  double scale_ = 1, x_ = 0, y_ = 0;
};

}  // namespace kte::detail::svg
