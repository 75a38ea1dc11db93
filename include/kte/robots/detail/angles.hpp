#pragma once

#include <kte/math/axis.hpp>
#include <kte/math/quaternion.hpp>
#include <kte/robots/description.hpp>

#include <cmath>
#include <numbers>

/// Rotations from the angles of files, with exact zeros and ones for quarter turns.
namespace kte::detail {

/// The nearest multiple of pi/2 of an angle, and the distance from it, rad.
struct quarter_turns {
  double count, distance;
};
inline quarter_turns nearest_quarter(double angle) {
  const double count = std::round(angle / (std::numbers::pi / 2));
  return {count, std::abs(angle - count * (std::numbers::pi / 2))};
}

/// Cosine and sine, exact if the angle is within `tolerance` of a quarter turn, or as close to one as a double can be.
inline rotation_2D<> turn_by(double angle, double tolerance) {
  const auto [count, distance] = nearest_quarter(angle);
  if (std::abs(angle) < 1e9 && distance <= tolerance + 2.3e-16 * std::abs(angle)) {
    const int k = static_cast<int>(std::fmod(count, 4.0) + 4) % 4;
    return {k == 0 ? 1.0 : k == 2 ? -1.0 : 0.0, k == 1 ? 1.0 : k == 3 ? -1.0 : 0.0};
  }
  return {std::cos(angle), std::sin(angle)};
}

/// Replaces -0 by 0, because files would show the sign.
inline mat3<vec3<>> without_minus_zero(const mat3<vec3<>>& m) {
  const auto clean = [](const vec3<>& v) { return vec3<>{v.x + 0.0, v.y + 0.0, v.z + 0.0}; };
  return {clean(m.x), clean(m.y), clean(m.z)};
}

/// The rotation about coordinate axis 0, 1, 2 by an angle.
inline mat3<vec3<>> turn_about(int which, double angle, double tolerance) {
  const auto [c, s] = turn_by(angle, tolerance);
  if (which == 0) return {{1, 0, 0}, {0, c, -s}, {0, s, c}};
  if (which == 1) return {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
  return {{c, -s, 0}, {s, c, 0}, {0, 0, 1}};
}

/// The rotation of roll, pitch and yaw: about the fixed axes x, y, z in this order,
///
///   R = Rot(z, yaw) Rot(y, pitch) Rot(x, roll)          (1)
inline mat3<vec3<>> rotation_of_rpy(const vec3<>& rpy, double tolerance) {
  return without_minus_zero(turn_about(2, rpy.z, tolerance) *
                            (turn_about(1, rpy.y, tolerance) * turn_about(0, rpy.x, tolerance)));  // (1)
}

/// The inverse of (1), with pitch in [-pi/2, pi/2], and roll 0 where pitch is a quarter turn. Quarter turns are exact,
/// so that (1) gives the same zeros and ones. Near pitch pi/2 yaw has few accurate digits; roll is computed from the
/// rotation without this yaw, so that (1) gives the same rotation to rounding.
inline vec3<> rpy_of_rotation(const mat3<vec3<>>& m) {
  const double across = std::hypot(m.x.x, m.y.x);
  const double pitch = std::atan2(-m.z.x, across) + 0.0;
  if (across < 1e-15) return {0, pitch, std::atan2(-m.x.y, m.y.y) + 0.0};
  const double yaw = std::atan2(m.y.x, m.x.x) + 0.0;
  const auto [c, s] = turn_by(yaw, 1e-15);
  return {std::atan2(s * m.x.z - c * m.y.z, c * m.y.y - s * m.x.y) + 0.0, pitch, yaw};
}

/// The pose a, followed by b in the axes of a.
inline robot_pose operator*(const robot_pose& a, const robot_pose& b) {
  return {a.position + a.rotation * b.position, without_minus_zero(a.rotation * b.rotation)};
}
inline robot_pose inverse_of(const robot_pose& a) {
  const auto back = transpose(a.rotation);
  const vec3<> p = back * a.position;
  return {{0.0 - p.x, 0.0 - p.y, 0.0 - p.z}, back};
}
inline bool is_nothing(const robot_pose& a) { return a == robot_pose{}; }

/// The smallest rotation that takes z to the unit vector n; for n = -z the half turn about x.
///
///   u = z x n,   R = 1 + [u]x + [u]x^2 / (1 + n_z),   1/(1 + n_z) = (1 - n_z)/(n_x^2 + n_y^2)          (2)
inline mat3<vec3<>> shortest_turn_of_z_to(const vec3<>& n) {
  const double across = n.x * n.x + n.y * n.y;
  if (across == 0) return n.z > 0 ? robot_pose{}.rotation : mat3<vec3<>>{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const double k = (1 - n.z) / across;
  return without_minus_zero(
      {{1 - k * n.x * n.x, -k * n.x * n.y, n.x}, {-k * n.x * n.y, 1 - k * n.y * n.y, n.y}, {-n.x, -n.y, n.z}});  // (2)
}
/// A rotation that takes z to n: for the axes x and y a cyclic permutation of the axes, otherwise the smallest
/// rotation.
inline mat3<vec3<>> turn_of_z_to(const vec3<>& n) {
  if (n == vec3<>{1, 0, 0}) return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  if (n == vec3<>{0, 1, 0}) return {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  return shortest_turn_of_z_to(n);
}

/// The body with `place` applied: b is in the axes of a frame at `place` in the link.
inline rigid_body<> moved_body(const robot_pose& place, const rigid_body<>& b) {
  if (is_nothing(place)) return b;
  return {b.mass, place.position + place.rotation * b.com, congruence(place.rotation, b.inertia), b.published};
}

}  // namespace kte::detail
