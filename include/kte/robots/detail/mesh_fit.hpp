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
/// mesh, first the axis of the largest moment of inertia, so that z is along the longest side. The shape is at the
/// centre of mass and follows from the box of equal inertia, with half edges a <= b <= c:
///
///   a^2 = 3 S_xx/V, ...,   V and S as in mesh_body.hpp                       (1)
///
///   box, ellipsoid  a, b, c
///   cylinder        radius (a + b)/2, half length c
///   capsule         radius r = (a + b)/2, half length c - r/2
///   sphere          radius (a + b + c)/3
/// With `aabb` it is at the centre of the bounding box in these axes, whose half edges are a, b, c:
///   box, ellipsoid  a, b, c
///   cylinder        radius max(a, b), half length c
///   capsule         radius r = max(a, b), half length c - r, at least 0
///   sphere          radius max(a, b, c)
/// Throws `bad_argument` for other shapes, and under the conditions of `moments_of`.
fitted_geom fit_mesh(const triangle_mesh& mesh, mesh_inertia kind, robot_shape::form form, bool aabb);

}  // namespace kte::detail

#ifdef KTE_FUNCTION
#  include <kte/math/principal_moments.hpp>
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

/// Half edges (1), the shortest first. For needles S has them with all digits, I has not.
inline vec3<> equal_box(const sym3<>& second, double amount) {
  const auto [x, y, z] = principal_moments(second);
  const auto half = [&](double moment) { return std::sqrt(3 * (std::max)(0.0, moment) / amount); };
  return {half(z), half(y), half(x)};  // (1)
}

/// The half edges of the bounding box of a mesh in these axes, and its centre in the mesh.
inline std::pair<vec3<>, vec3<>> bounding_box(const triangle_mesh& mesh, const mat3<vec3<>>& axes) {
  const auto back = transpose(axes);
  vec3<> low = back * mesh.vertices[0], high = low;
  for (const auto& v : mesh.vertices) {
    const vec3<> p = back * v;
    low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
    high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
  }
  return {0.5 * (high - low), axes * (0.5 * (low + high))};
}

KTE_FUNCTION fitted_geom fit_mesh(const triangle_mesh& mesh, mesh_inertia kind, robot_shape::form form, bool aabb) {
  using shape = robot_shape::form;
  if (form != shape::box && form != shape::ellipsoid && form != shape::cylinder && form != shape::capsule &&
      form != shape::sphere)
    raise<bad_argument>("kte: a mesh can be fitted with a box, ellipsoid, cylinder, capsule or sphere only");
  const auto m = moments_of(mesh, kind);
  const auto axes = principal_axes(m.second);
  const auto [box, at] = aabb ? bounding_box(mesh, axes) : std::pair{equal_box(m.second, m.amount), m.centre};
  const double across = aabb ? (std::max)(box.x, box.y) : (box.x + box.y) / 2;
  const double ball = aabb ? (std::max)(across, box.z) : (box.x + box.y + box.z) / 3;
  const vec3<> half = form == shape::cylinder  ? vec3<>{across, box.z, 0}
                      : form == shape::capsule ? vec3<>{across, (std::max)(0.0, box.z - across / (aabb ? 1 : 2)), 0}
                      : form == shape::sphere  ? vec3<>{ball, 0, 0}
                                               : box;
  return {{at, axes}, half};
}

}  // namespace kte::detail
#endif
