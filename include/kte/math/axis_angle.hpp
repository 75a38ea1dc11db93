#pragma once

#include <kte/math/quaternion.hpp>

#include <limits>

/// Rotations by axis and angle, and by the rotation vector: axis times angle. Conversions between these, quaternions
/// and matrices: matrix(r), to_quaternion(r), to_axis_angle(r), to_rotation_vector(r). They keep all digits over the
/// whole group; small rotations keep them relative to their angle. At half turns the sign of the axis is free.
namespace kte {

/// A rotation by `angle`, rad, about the unit vector `axis`. Conversions give an angle in [0, pi], and the axis x for
/// the identity.
template <class S = double>
struct axis_angle {
  using geometry = axis_angle;
  S angle = S(0);
  vec3<S> axis{S(1), S(0), S(0)};
  friend bool operator==(const axis_angle&, const axis_angle&) = default;
};

template <class S, class T>
constexpr axis_angle<S> as(const axis_angle<T>& r) {
  return {as<S>(r.angle), as<S>(r.axis)};
}

/// The quaternion w = cos(angle/2), (x, y, z) = sin(angle/2) axis, with the sign that makes w >= 0.
template <class S>
[[nodiscard]] constexpr unit_quaternion<S> to_quaternion(const axis_angle<S>& r) {
  using std::cos;
  using std::sin;
  const S half = r.angle / S(2);
  const S s = sin(half);
  return detail::canonical(unit_quaternion<S>{cos(half), s * r.axis.x, s * r.axis.y, s * r.axis.z});
}
/// The quaternion of a rotation vector r, rad, of length t:
///
///   w = cos(t/2),  (x, y, z) = sin(t/2)/t r                                (1)
///   sin(t/2)/t = 1/2 - t^2/48 + ...,  which is 1/2 if t^2 is below the last digit of 1
template <class X, class Y, class Z>
[[nodiscard]] constexpr auto to_quaternion(const vec3<X, Y, Z>& rotation_vector) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  using S = detail::scalar_of<decltype(dot(rotation_vector, rotation_vector))>;
  const auto r = as<S>(rotation_vector);
  const S tt = dot(r, r);
  if (tt <= std::numeric_limits<S>::epsilon()) {
    return unit_quaternion<S>{S(1) - tt / S(8), r.x / S(2), r.y / S(2), r.z / S(2)};
  }
  const S t = sqrt(tt);
  const S k = sin(S(t / S(2))) / t;
  return detail::canonical(unit_quaternion<S>{cos(S(t / S(2))), k * r.x, k * r.y, k * r.z});
}

/// The angle and axis of a quaternion: angle = 2 atan2(|u|, w), axis = u/|u|, u = (x, y, z). The arc cosine of w would
/// lose half the digits near 0, the arc sine of |u| near pi.
template <class S>
[[nodiscard]] constexpr axis_angle<S> to_axis_angle(const unit_quaternion<S>& rotation) {
  using std::atan2;
  using std::sqrt;
  const auto q = detail::canonical(rotation);
  const auto size = [](const S& a) { return a < 0 ? S(-a) : a; };
  if (q.x == 0 && q.y == 0 && q.z == 0) return {S(2) * atan2(S(0), q.w), {S(1), S(0), S(0)}};
  S most = size(q.x);  // scaled by it, no square vanishes
  if (most < size(q.y)) most = size(q.y);
  if (most < size(q.z)) most = size(q.z);
  const vec3<S> u{q.x / most, q.y / most, q.z / most};
  const S n = sqrt(dot(u, u));
  return {S(2) * atan2(S(most * n), q.w), {u.x / n, u.y / n, u.z / n}};
}
/// The rotation vector of a quaternion, rad: 2 atan2(|u|, w)/|u| u, u = (x, y, z); 2/w u where |u|^2 is below the last
/// digit of 1.
template <class S>
[[nodiscard]] constexpr vec3<S> to_rotation_vector(const unit_quaternion<S>& rotation) {
  using std::atan2;
  using std::sqrt;
  const auto q = detail::canonical(rotation);
  const S uu = q.x * q.x + q.y * q.y + q.z * q.z;
  const S n = sqrt(uu);
  const S k = uu <= std::numeric_limits<S>::epsilon() / S(4) ? S(S(2) / q.w) : S(S(2) * atan2(n, q.w) / n);
  return {k * q.x, k * q.y, k * q.z};
}

// ---- conversions by way of these
template <class S>
[[nodiscard]] constexpr mat3<vec3<S>> matrix(const axis_angle<S>& r) {
  return matrix(to_quaternion(r));
}
template <class X, class Y, class Z>
[[nodiscard]] constexpr auto matrix(const vec3<X, Y, Z>& rotation_vector) {
  return matrix(to_quaternion(rotation_vector));
}
template <class RX, class RY, class RZ>
[[nodiscard]] constexpr auto to_axis_angle(const mat3<RX, RY, RZ>& m) {
  return to_axis_angle(to_quaternion(m));
}
template <class X, class Y, class Z>
[[nodiscard]] constexpr auto to_axis_angle(const vec3<X, Y, Z>& rotation_vector) {
  return to_axis_angle(to_quaternion(rotation_vector));
}
template <class RX, class RY, class RZ>
[[nodiscard]] constexpr auto to_rotation_vector(const mat3<RX, RY, RZ>& m) {
  return to_rotation_vector(to_quaternion(m));
}
template <class S>
[[nodiscard]] constexpr vec3<S> to_rotation_vector(const axis_angle<S>& r) {
  return to_rotation_vector(to_quaternion(r));
}

}  // namespace kte
