#pragma once

#include <kte/errors.hpp>
#include <kte/math/rotation_2D.hpp>
#include <kte/math/squares.hpp>

#include <limits>

namespace kte {

/// A rotation as a unit quaternion w + x i + y j + z k (Hamilton). Like a rotation matrix it maps axes of the rotated
/// frame to axes of its parent; a*b rotates by b first. q and -q are one rotation.
template <class S = double>
struct unit_quaternion {
  using geometry = unit_quaternion;
  S w = S(1);
  S x = S(0);
  S y = S(0);
  S z = S(0);
  friend bool operator==(const unit_quaternion&, const unit_quaternion&) = default;
};
template <class S>
unit_quaternion(S, S, S, S) -> unit_quaternion<S>;

/// The quaternion with entries of the scalar S.
template <class S, class T>
KTE_INLINE constexpr unit_quaternion<S> as(const unit_quaternion<T>& q) {
  return {as<S>(q.w), as<S>(q.x), as<S>(q.y), as<S>(q.z)};
}
/// The inverse rotation: w - x i - y j - z k.
template <class S>
[[nodiscard]] KTE_INLINE constexpr unit_quaternion<S> conjugate(const unit_quaternion<S>& q) {
  return {q.w, -q.x, -q.y, -q.z};
}
/// The inverse rotation, as `transpose` of a matrix.
template <class S>
[[nodiscard]] KTE_INLINE constexpr unit_quaternion<S> transpose(const unit_quaternion<S>& q) {
  return conjugate(q);
}
/// The inner product: up to its sign, the cosine of half the angle between two rotations.
template <class S>
[[nodiscard]] KTE_INLINE constexpr S dot(const unit_quaternion<S>& a, const unit_quaternion<S>& b) {
  return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
KTE_INLINE constexpr unit_quaternion<S> operator*(const unit_quaternion<S>& a, const unit_quaternion<S>& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
/// q v q* = v + w t + u x t,  t = 2 u x v,  u = (x, y, z)            (1)
template <class S, class A, class B, class C>
KTE_INLINE constexpr auto operator*(const unit_quaternion<S>& q, const vec3<A, B, C>& v) {
  const vec3 u{q.x, q.y, q.z};
  const auto t = constant<2>{} * cross(u, v);
  return v + (q.w * t + cross(u, t));
}

namespace detail {
/// (1) for the three axes, with s instead of 2 and `unity` instead of 1.
template <class S>
KTE_INLINE constexpr mat3<vec3<S>> turned_axes(const unit_quaternion<S>& q, const S& s, const S& unity = S(1)) {
  const S x = s * q.x, y = s * q.y, z = s * q.z;
  const S xx = x * q.x, xy = x * q.y, xz = x * q.z, yy = y * q.y, yz = y * q.z, zz = z * q.z;
  const S wx = x * q.w, wy = y * q.w, wz = z * q.w;
  return {{unity - (yy + zz), xy - wz, xz + wy},
          {xy + wz, unity - (xx + zz), yz - wx},
          {xz - wy, yz + wx, unity - (xx + yy)}};
}
}  // namespace detail

/// The rotation matrix.
template <class S>
[[nodiscard]] KTE_INLINE constexpr mat3<vec3<S>> matrix(const unit_quaternion<S>& q) {
  return detail::turned_axes(q, S(2));
}
/// The rotation matrix of a quaternion of any length but 0: with 2/|q|^2 instead of 2, so that errors of the length
/// have no effect. NaN where q is 0 or not finite.
template <class S>
[[nodiscard]] KTE_INLINE constexpr mat3<vec3<S>> matrix_of_any_length(const unit_quaternion<S>& q) {
  unit_quaternion<S> u = q;
  S n = dot(u, u);
  if (!detail::keeps_digits(n)) [[unlikely]] {
    const S k = detail::scale_for_squares(n);
    u = {k * q.w, k * q.x, k * q.y, k * q.z}, n = dot(u, u);
  }
  return detail::turned_axes(u, S(S(2) / n), S(S(1) + S(0) * n));
}
template <class S, class RX, class RY, class RZ>
KTE_INLINE constexpr auto operator*(const unit_quaternion<S>& q, const mat3<RX, RY, RZ>& m) {
  return matrix(q) * m;
}
template <class S, class RX, class RY, class RZ>
KTE_INLINE constexpr auto operator*(const mat3<RX, RY, RZ>& m, const unit_quaternion<S>& q) {
  return m * matrix(q);
}
/// R A R^T for symmetric A and the rotation matrix R of q.
template <class S, class... T>
[[nodiscard]] KTE_INLINE constexpr auto congruence(const unit_quaternion<S>& q, const sym3<T...>& a) {
  return congruence(matrix(q), a);
}

/// The quaternion w + x i + y j + z k normalized to length 1. Throws `bad_argument` if its length is 0 or not finite.
template <variable S>
[[nodiscard]] constexpr auto normalized(const S& w, const S& x, const S& y, const S& z) {
  using std::sqrt;
  using T = decltype(real(w));
  const auto larger = [](const T& a, const T& b) { return a < b ? b : a; };
  const auto size = [](const T& a) { return a < 0 ? T(-a) : a; };
  const T most = larger(larger(size(w), size(x)), larger(size(y), size(z)));
  const T sum = size(w) / most + size(x) / most + size(y) / most + size(z) / most;
  if (!(sum >= 1 && sum <= 4))  // 0 / 0, or not finite
    detail::raise<bad_argument>("kte: a quaternion of length 0, or one that is not finite, is not a rotation");
  const unit_quaternion<T> q{w / most, x / most, y / most, z / most};  // no square of it overflows, or vanishes unduly
  const T n = sqrt(dot(q, q));
  return unit_quaternion<T>{q.w / n, q.x / n, q.y / n, q.z / n};
}

namespace detail {
/// The scalar of a sum of entries; double if all of them are typed.
template <class T>
using scalar_of = std::conditional_t<typed_constant<T>, double, decltype(real(T()))>;

/// Of q and -q, the quaternion with w >= 0.
template <class S>
constexpr unit_quaternion<S> canonical(const unit_quaternion<S>& q) {
  return q.w < 0 ? unit_quaternion<S>{-q.w, -q.x, -q.y, -q.z} : q;
}
}  // namespace detail

/// The quaternion, w >= 0, of a rotation matrix m. With the squares of
///
///   4 w w = 1 + m.x.x + m.y.y + m.z.z,  4 x x = 1 + m.x.x - m.y.y - m.z.z,  ...                (2)
///   4 w x = m.z.y - m.y.z,  4 x y = m.x.y + m.y.x,  ...                                        (3)
///
/// q times four times its largest component (Shepperd, J. Guidance and Control 1, 1978). Throws bad_argument if m is
/// not orthonormal to 1e-6 (in float, to a thousand rounding errors) and right-handed.
template <class RX, class RY, class RZ>
[[nodiscard]] constexpr auto to_quaternion(const mat3<RX, RY, RZ>& rotation) {
  using S = detail::scalar_of<decltype(dot(rotation.x, rotation.x + (rotation.y + rotation.z)))>;
  const auto m = as<S>(rotation);
  const S eps = std::numeric_limits<S>::epsilon();
  const S most = eps > S(1e-9) ? S(S(1000) * eps) : S(1e-6);
  const auto tiny = [&](const S& d) { return d <= most && d >= -most; };
  if (!(tiny(dot(m.x, m.x) - S(1)) && tiny(dot(m.y, m.y) - S(1)) && tiny(dot(m.z, m.z) - S(1)) && tiny(dot(m.x, m.y)) &&
        tiny(dot(m.y, m.z)) && tiny(dot(m.z, m.x)) && dot(m.x, cross(m.y, m.z)) > 0))
    detail::raise<bad_argument>("kte: a rotation matrix must be orthonormal and right-handed");
  const S a = m.x.x, b = m.y.y, c = m.z.z, trace = a + b + c;
  const S wx = m.z.y - m.y.z, wy = m.x.z - m.z.x, wz = m.y.x - m.x.y;  // (3)
  const S xy = m.x.y + m.y.x, yz = m.y.z + m.z.y, zx = m.z.x + m.x.z;
  const auto q = [&] {
    if (trace >= a && trace >= b && trace >= c) return normalized(S(1) + trace, wx, wy, wz);
    if (a >= b && a >= c) return normalized(wx, S(S(1) + a - b - c), xy, zx);
    if (b >= c) return normalized(wy, xy, S(S(1) + b - c - a), yz);
    return normalized(wz, zx, yz, S(S(1) + c - a - b));
  }();
  return detail::canonical(q);
}

}  // namespace kte
