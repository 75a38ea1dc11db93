#pragma once

#include <kte/math/matrix.hpp>

/// Rotations about x and z of vectors and matrices. Typed constants that a rotation does not change stay typed.
namespace kte::tree {

/// A rotation by its cosine and sine. `out` transforms components from rotated axes to the previous axes, `in`
/// transforms them back.
template <class S>
struct turn {
  S cos = S(1), sin = S(0);
  KTE_INLINE turn back() const { return {cos, -sin}; }
};
/// The product of two rotations about one axis.
template <class T, class S>
KTE_INLINE turn<S> operator*(const turn<T>& a, const turn<S>& b) {
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

template <class T, class X, class Y, class Z>
KTE_INLINE auto out_z(const turn<T>& t, const vec3<X, Y, Z>& u) {
  return vec3{t.cos * u.x - t.sin * u.y, t.sin * u.x + t.cos * u.y, u.z};
}
template <class T, class X, class Y, class Z>
KTE_INLINE auto in_z(const turn<T>& t, const vec3<X, Y, Z>& u) {
  return vec3{t.cos * u.x + t.sin * u.y, t.cos * u.y - t.sin * u.x, u.z};
}
template <class T, class X, class Y, class Z>
KTE_INLINE auto out_x(const turn<T>& t, const vec3<X, Y, Z>& u) {
  return vec3{u.x, t.cos * u.y - t.sin * u.z, t.sin * u.y + t.cos * u.z};
}
template <class T, class X, class Y, class Z>
KTE_INLINE auto in_x(const turn<T>& t, const vec3<X, Y, Z>& u) {
  return vec3{u.x, t.cos * u.y + t.sin * u.z, t.cos * u.z - t.sin * u.y};
}

/// R A, which rotates the rows of A.
template <class T, class Row>
KTE_INLINE mat3<Row> rows_out_z(const turn<T>& t, const mat3<Row>& a) {
  return {t.cos * a.x - t.sin * a.y, t.sin * a.x + t.cos * a.y, a.z};
}
template <class T, class Row>
KTE_INLINE mat3<Row> rows_out_x(const turn<T>& t, const mat3<Row>& a) {
  return {a.x, t.cos * a.y - t.sin * a.z, t.sin * a.y + t.cos * a.z};
}

/// R A R^T. Squares of cosine and sine are not substituted for each other, so quarter turns keep the digits of small
/// entries.
template <class T, class... A>
KTE_INLINE auto out_z(const turn<T>& t, const sym3<A...>& a) {
  const T cc = t.cos * t.cos, ss = t.sin * t.sin, cs = t.cos * t.sin;
  const auto twice = (cs + cs) * a.xy;
  return sym3{cc * a.xx - twice + ss * a.yy, cs * (a.xx - a.yy) + (cc - ss) * a.xy, t.cos * a.xz - t.sin * a.yz,
              ss * a.xx + twice + cc * a.yy, t.sin * a.xz + t.cos * a.yz,           a.zz};
}
template <class T, class... A>
KTE_INLINE auto out_x(const turn<T>& t, const sym3<A...>& a) {
  const T cc = t.cos * t.cos, ss = t.sin * t.sin, cs = t.cos * t.sin;
  const auto twice = (cs + cs) * a.yz;
  return sym3{a.xx,
              t.cos * a.xy - t.sin * a.xz,
              t.sin * a.xy + t.cos * a.xz,
              cc * a.yy - twice + ss * a.zz,
              cs * (a.yy - a.zz) + (cc - ss) * a.yz,
              ss * a.yy + twice + cc * a.zz};
}
template <class T, class... Row>
KTE_INLINE auto out_z(const turn<T>& t, const mat3<Row...>& a) {
  return mat3{out_z(t, t.cos * a.x - t.sin * a.y), out_z(t, t.sin * a.x + t.cos * a.y), out_z(t, a.z)};
}
template <class T, class... Row>
KTE_INLINE auto out_x(const turn<T>& t, const mat3<Row...>& a) {
  return mat3{out_x(t, a.x), out_x(t, t.cos * a.y - t.sin * a.z), out_x(t, t.sin * a.y + t.cos * a.z)};
}

}  // namespace kte::tree
