#pragma once

#include <kte/math/vec.hpp>

/// 3x3 matrices by components, general and symmetric.
namespace kte {

/// A 3x3 matrix with the rows x, y, z; m.y.x is row 2, column 1.
template <class RX = vec3<>, class RY = RX, class RZ = RY>
struct mat3 {
  using geometry = mat3;
  RX x;
  RY y;
  RZ z;
  friend bool operator==(const mat3&, const mat3&) = default;
};
template <class RX, class RY, class RZ>
mat3(RX, RY, RZ) -> mat3<RX, RY, RZ>;

/// A symmetric 3x3 matrix, stored as its upper triangle: `xx`, `xy`, `xz`, `yy`, `yz`, `zz`.
template <class XX = double, class XY = XX, class XZ = XY, class YY = XZ, class YZ = YY, class ZZ = YZ>
struct sym3 {
  using geometry = sym3;
  XX xx;
  XY xy;
  XZ xz;
  YY yy;
  YZ yz;
  ZZ zz;
  friend bool operator==(const sym3&, const sym3&) = default;
};
template <class XX, class XY, class XZ, class YY, class YZ, class ZZ>
sym3(XX, XY, XZ, YY, YZ, ZZ) -> sym3<XX, XY, XZ, YY, YZ, ZZ>;

/// The diagonal matrix diag(xx, yy, zz).
template <class XX, class YY, class ZZ>
[[nodiscard]] constexpr auto diagonal(XX xx, YY yy, ZZ zz) {
  return sym3{xx, zero, zero, yy, zero, zz};
}

/// The matrix with entries of the scalar S.
template <class S, class RX, class RY, class RZ>
KTE_INLINE constexpr mat3<vec3<S>> as(const mat3<RX, RY, RZ>& m) {
  return {as<S>(m.x), as<S>(m.y), as<S>(m.z)};
}
template <class S, class... T>
KTE_INLINE constexpr sym3<S> as(const sym3<T...>& m) {
  return {as<S>(m.xx), as<S>(m.xy), as<S>(m.xz), as<S>(m.yy), as<S>(m.yz), as<S>(m.zz)};
}

/// M^T
template <class RX, class RY, class RZ>
[[nodiscard]] KTE_INLINE constexpr auto transpose(const mat3<RX, RY, RZ>& m) {
  return mat3{vec3{m.x.x, m.y.x, m.z.x}, vec3{m.x.y, m.y.y, m.z.y}, vec3{m.x.z, m.y.z, m.z.z}};
}
template <class RX, class RY, class RZ, class A, class B, class C>
KTE_INLINE constexpr auto operator*(const mat3<RX, RY, RZ>& m, const vec3<A, B, C>& v) {
  return vec3{dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}
template <class RX, class RY, class RZ, class QX, class QY, class QZ>
KTE_INLINE constexpr auto operator*(const mat3<RX, RY, RZ>& a, const mat3<QX, QY, QZ>& b) {
  const auto t = transpose(b);
  return mat3{t * a.x, t * a.y, t * a.z};
}

template <class... R, class... Q>
KTE_INLINE constexpr auto operator+(const mat3<R...>& a, const mat3<Q...>& b) {
  return mat3{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class... R, class... Q>
KTE_INLINE constexpr auto operator-(const mat3<R...>& a, const mat3<Q...>& b) {
  return mat3{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <entry S, class RX, class RY, class RZ>
KTE_INLINE constexpr auto operator*(const S& s, const mat3<RX, RY, RZ>& m) {
  return mat3{s * m.x, s * m.y, s * m.z};
}
/// The skew-symmetric matrix [v]x: [v]x u = v x u.
template <class X, class Y, class Z>
[[nodiscard]] KTE_INLINE constexpr auto cross_matrix(const vec3<X, Y, Z>& v) {
  return mat3{vec3{zero, -v.z, v.y}, vec3{v.z, zero, -v.x}, vec3{-v.y, v.x, zero}};
}
/// a b^T
template <class A, class B, class C, class D, class E, class F>
[[nodiscard]] KTE_INLINE constexpr auto dyad(const vec3<A, B, C>& a, const vec3<D, E, F>& b) {
  return mat3{a.x * b, a.y * b, a.z * b};
}
/// s 1
template <class S>
[[nodiscard]] KTE_INLINE constexpr auto diagonal_matrix(const S& s) {
  return mat3{vec3{s, zero, zero}, vec3{zero, s, zero}, vec3{zero, zero, s}};
}

/// All nine entries of a symmetric matrix.
template <class... T>
[[nodiscard]] KTE_INLINE constexpr auto full(const sym3<T...>& m) {
  return mat3{vec3{m.xx, m.xy, m.xz}, vec3{m.xy, m.yy, m.yz}, vec3{m.xz, m.yz, m.zz}};
}
template <class... T, class A, class B, class C>
KTE_INLINE constexpr auto operator*(const sym3<T...>& m, const vec3<A, B, C>& v) {
  return full(m) * v;
}
template <class... T, class... U>
KTE_INLINE constexpr auto operator+(const sym3<T...>& a, const sym3<U...>& b) {
  return sym3{a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

/// The sum of the diagonal.
template <class... T>
[[nodiscard]] KTE_INLINE constexpr auto trace(const sym3<T...>& m) {
  return m.xx + (m.yy + m.zz);
}

/// R A R^T for symmetric A, by its six entries.
template <class RX, class RY, class RZ, class... T>
[[nodiscard]] KTE_INLINE constexpr auto congruence(const mat3<RX, RY, RZ>& r, const sym3<T...>& a) {
  const auto m = full(a);
  const auto bx = m * r.x;  // columns of A R^T
  const auto by = m * r.y;
  const auto bz = m * r.z;
  return sym3{dot(r.x, bx), dot(r.x, by), dot(r.x, bz), dot(r.y, by), dot(r.y, bz), dot(r.z, bz)};
}

}  // namespace kte
