#include "element_parameters.hpp"

#include <kte/math/quaternion.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "element_kinds.hpp"

namespace kte::view {

namespace {
using detail::element_parts;

const std::vector<double>* values(const element_parts& e, std::string_view name, std::size_t count) {
  for (const auto& p : e.parameters)
    if (p.name == name && p.values.size() == count) return &p.values;
  return nullptr;
}
std::array<double, 4> quaternion_of(const std::vector<double>& rows) {
  const auto& r = rows;
  const auto q = to_quaternion(mat3<vec3<>>{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}});
  return {q.w, q.x, q.y, q.z};
}
std::array<double, 3> turned(const std::vector<double>& rows, const std::array<double, 3>& v) {
  std::array<double, 3> u{};
  for (std::size_t i = 0; i < 3; ++i) u[i] = rows[3 * i] * v[0] + rows[3 * i + 1] * v[1] + rows[3 * i + 2] * v[2];
  return u;
}
}  // namespace

std::size_t parameter_count(const element_parts& e, std::string_view name) {
  for (const auto& p : e.parameters)
    if (p.name == name) return p.values.size();
  return 0;
}
double number_parameter(const element_parts& e, std::string_view name, double otherwise) {
  const auto* const x = values(e, name, 1);
  return x == nullptr ? otherwise : (*x)[0];
}
std::array<double, 3> vector_parameter(const element_parts& e, std::string_view name,
                                       const std::array<double, 3>& otherwise) {
  const auto* const x = values(e, name, 3);
  return x == nullptr ? otherwise : std::array<double, 3>{(*x)[0], (*x)[1], (*x)[2]};
}

bool has_constant_pose(const element_parts& e) {
  const auto stem = kind_of_element(e.type).stem;
  return stem == "rigid_link" || stem == "virtual_kte_interface";
}
scene::pose constant_pose(const element_parts& e) {
  scene::pose p = scene::at_origin;
  const auto at = vector_parameter(e, "position", {});
  std::copy(at.begin(), at.end(), p.begin());
  if (const auto* const r = values(e, "rotation", 9)) {
    const auto q = quaternion_of(*r);
    std::copy(q.begin(), q.end(), p.begin() + 3);
  }
  return p;
}

bool is_placed(const element_parts& joint) {
  const auto at = vector_parameter(joint, "position", {});
  return at != std::array<double, 3>{};
}
std::array<double, 3> placement_turned(const element_parts& joint, const std::array<double, 3>& v) {
  const auto* const r = values(joint, "rotation", 9);
  return r == nullptr ? v : turned(*r, v);
}

/// Principal moments I = m (b^2 + c^2)/5 of half axes a, b, c give
///
///   a^2 = 5/(2m) (I_b + I_c - I_a)                                           (1)
///
/// In the plane there is one moment, and a = b.
scene::body body_of(const element_parts& inertia) {
  scene::body b;
  b.mass = number_parameter(inertia, "mass", 0);
  b.centre = vector_parameter(inertia, "com", {});
  const auto* const i = values(inertia, "inertia", 6);
  if (i == nullptr || !(b.mass > 0)) return b;
  const auto& x = *i;
  const auto half_axis = [&b](double square) { return square > 0 ? std::sqrt(2.5 * square / b.mass) : 0; };
  if (inertia.type.ends_with("_2D")) {
    b.ellipsoid = {half_axis(x[5]), half_axis(x[5]), 0};
    return b;
  }
  Eigen::Matrix3d m;
  m << x[0], x[1], x[2], x[1], x[3], x[4], x[2], x[4], x[5];
  Eigen::Vector3d moments = m.diagonal();
  if (x[1] != 0 || x[2] != 0 || x[4] != 0) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
    Eigen::Matrix3d axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Eigen::Quaterniond q(axes);
    moments = solver.eigenvalues(), b.orientation = {q.w(), q.x(), q.y(), q.z()};
  }
  for (int k = 0; k < 3; ++k)
    b.ellipsoid[static_cast<std::size_t>(k)] = half_axis(moments.sum() - 2 * moments[k]);  // (1)
  return b;
}

}  // namespace kte::view
