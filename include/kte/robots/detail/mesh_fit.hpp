#pragma once

#include <kte/robots/description.hpp>
#include <kte/robots/detail/mesh_body.hpp>

namespace kte::detail {

/// The shape that replaces a mesh.
struct fitted_geom {
  robot_pose pose;  ///< in the mesh
  vec3<> half{};    ///< sphere: radius; capsule, cylinder: radius, half length along z; box, ellipsoid: half axes
};

/// Fits a sphere, capsule, cylinder, ellipsoid or box to a mesh, as MuJoCo does. The axes are the principal axes of the
/// mesh, first the axis of the largest moment of inertia, so that z is along the longest side. The shape follows from
/// the box of equal inertia at the centre of mass, with half edges a, b, c (mesh_body.hpp (4)):
///   box, ellipsoid  a, b, c
///   cylinder        radius (a + b)/2, half length c
///   capsule         radius r = (a + b)/2, half length c - r/2
///   sphere          radius (a + b + c)/3
/// With `aabb` it follows from the bounding box in these axes, about the centre of the box, for all vertices (x, y, z
/// from this centre):
///   box, ellipsoid  half edges of the bounding box
///   cylinder        radius max sqrt(x^2 + y^2), half length c
///   capsule         radius r of the cylinder, half length max |z| - sqrt(r^2 - x^2 - y^2)
///   sphere          radius max sqrt(x^2 + y^2 + z^2)
/// (MuJoCo 2.2.2 computes these sizes but places the shapes wrongly: it omits the centre of mass and the principal
/// axes.) Throws `bad_argument` for other shapes, and under the conditions of `moments_of`.
fitted_geom fit_mesh(const triangle_mesh& mesh, mesh_inertia kind, robot_shape::form form, bool aabb);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/angles.hpp>

#  include <Eigen/Eigenvalues>

namespace kte::detail {

/// The principal axes as columns: first the axis of the largest moment of inertia, which is the smallest of S. Products
/// within rounding error are taken as 0, so that bodies with equal moments keep their axes.
inline mat3<vec3<>> principal_axes(const sym3<>& second) {
  const auto& s = second;
  const auto product = [](double xy, double xx, double yy) {
    return std::abs(xy) <= 1e-12 * std::sqrt(std::abs(xx)) * std::sqrt(std::abs(yy)) ? 0.0 : xy;
  };
  const double xy = product(s.xy, s.xx, s.yy), xz = product(s.xz, s.xx, s.zz), yz = product(s.yz, s.yy, s.zz);
  Eigen::Matrix3d m;
  m << s.xx, xy, xz, xy, s.yy, yz, xz, yz, s.zz;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(m / trace(s));
  const auto column = [&](int k) {
    const auto v = solved.eigenvectors().col(k);
    return vec3<>{v(0), v(1), v(2)};
  };
  const vec3<> x = column(0), y = column(1);
  return without_minus_zero(transpose(mat3<vec3<>>{x, y, cross(x, y)}));
}

/// The sizes of a shape that contains all points; `box`: half edges of their bounding box.
inline vec3<> bounding_size(robot_shape::form form, const std::vector<vec3<>>& points, const vec3<>& box) {
  using shape = robot_shape::form;
  if (form == shape::box || form == shape::ellipsoid) return box;
  double radius = 0, half = form == shape::cylinder ? box.z : 0;
  const auto across = [](const vec3<>& p) { return p.x * p.x + p.y * p.y; };
  for (const auto& p : points) radius = (std::max)(radius, form == shape::sphere ? dot(p, p) : across(p));
  for (const auto& p : points)
    if (form == shape::capsule) half = (std::max)(half, std::abs(p.z) - std::sqrt((std::max)(0.0, radius - across(p))));
  return {std::sqrt(radius), half, 0};
}

KTE_FUNCTION fitted_geom fit_mesh(const triangle_mesh& mesh, mesh_inertia kind, robot_shape::form form, bool aabb) {
  using shape = robot_shape::form;
  if (form != shape::box && form != shape::ellipsoid && form != shape::cylinder && form != shape::capsule &&
      form != shape::sphere)
    raise<bad_argument>("kte: a mesh can be fitted with a box, ellipsoid, cylinder, capsule or sphere only");
  const auto m = moments_of(mesh, kind);
  const auto axes = principal_axes(m.second);
  if (!aabb) {
    const auto b = equal_box(m.second, m.amount);
    const double r = (b.x + b.y) / 2;
    const vec3<> half = form == shape::cylinder  ? vec3<>{r, b.z, 0}
                        : form == shape::capsule ? vec3<>{r, b.z - r / 2, 0}
                        : form == shape::sphere  ? vec3<>{(b.x + b.y + b.z) / 3, 0, 0}
                                                 : b;
    return {{m.centre, axes}, half};
  }
  std::vector<vec3<>> points;
  points.reserve(mesh.vertices.size());
  for (const auto& v : mesh.vertices) points.push_back(transpose(axes) * (v - m.centre));
  vec3<> low = points[0], high = low;
  for (const auto& p : points) {
    low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
    high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
  }
  const vec3<> middle = 0.5 * (low + high);
  for (auto& p : points) p = p - middle;
  return {{m.centre + axes * middle, axes}, bounding_size(form, points, 0.5 * (high - low))};
}

}  // namespace kte::detail
#endif
