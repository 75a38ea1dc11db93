#pragma once

#include <kte/view/svg/mechanism/scene_motion.hpp>
#include <kte/view/svg/mechanism/scene_view.hpp>
#include <kte/view/svg/mechanism/styles.hpp>

namespace kte::detail::svg {

/// The three half axes of the ellipsoid of a body, as vectors in the world.
inline std::array<vec3<>, 3> half_axes(const scene::body& b, const placed_frame& f) {
  const auto& o = b.orientation;
  const auto turned = f.rotation * normalized(o[0], o[1], o[2], o[3]);
  return {turned * vec3{b.ellipsoid[0], 0.0, 0.0}, turned * vec3{0.0, b.ellipsoid[1], 0.0},
          turned * vec3{0.0, 0.0, b.ellipsoid[2]}};
}

/// The outline of an ellipsoid in parallel projection: x = c + A u, |u| = 1, where A A^T is the sum of the dyads of its
/// projected half axes. A point mass is a disc.
inline drawn_shape body_symbol(const scene_view& view, const scene::body& b, const placed_frame& f, double least_radius,
                               const std::string& name) {
  const vec3<> centre = f({b.centre[0], b.centre[1], b.centre[2]});
  const auto at = view(centre);
  double xx = 0, xy = 0, yy = 0;
  for (const auto& axis : half_axes(b, f)) {
    const double x = view.scale() * view.across(axis), y = -view.scale() * view.upwards(axis);
    xx += x * x, xy += x * y, yy += y * y;
  }
  if (view.scale() * *std::max_element(b.ellipsoid.begin(), b.ellipsoid.end()) < least_radius)
    return {styles::point_mass, name, {at}, least_radius};
  // The symmetric root of [xx xy; xy yy]: (M + r I) / t with r = sqrt(det M), t = sqrt(trace M + 2 r).
  const double root = std::sqrt((std::max)(xx * yy - xy * xy, 0.0)), t = std::sqrt(xx + yy + 2 * root);
  const double a = (xx + root) / t, c = xy / t, d = (yy + root) / t;
  return {styles::body,
          name,
          ellipse_points<picture_point>(0, 4,
                                        [&](double x, double y) {
                                          return picture_point{at.x + a * x + c * y, at.y + c * x + d * y};
                                        }),
          0,
          true,
          true};
}

}  // namespace kte::detail::svg
