#pragma once

#include <kte/math/matrix.hpp>

#include <cmath>

namespace kte {

/// A rotation about z, by its cosine `cos` and sine `sin`. It rotates vectors in space, so that planar and spatial
/// mechanisms share their formulas.
template <class C = double, class S = C>
struct rotation_2D {
  using geometry = rotation_2D;
  C cos;
  S sin;
  friend bool operator==(const rotation_2D&, const rotation_2D&) = default;
};
template <class C, class S>
rotation_2D(C, S) -> rotation_2D<C, S>;

/// The rotation by `angle` rad.
template <variable T>
[[nodiscard]] constexpr auto rotation_by(const T& angle) {
  using std::cos;
  using std::sin;
  const auto a = real(angle);
  return rotation_2D{decltype(a + a)(cos(a)), decltype(a + a)(sin(a))};
}

/// The angle in (-pi, pi], rad.
template <class S>
[[nodiscard]] S angle(const rotation_2D<S>& r) {
  using std::atan2;
  return atan2(r.sin, r.cos);
}

/// The identity rotation; products with it cost nothing.
struct no_rotation {
  using geometry = no_rotation;
  friend constexpr bool operator==(no_rotation, no_rotation) { return true; }
};

namespace detail {
template <class R>
inline constexpr bool is_planar_rotation = std::is_same_v<R, no_rotation>;
template <class C, class S>
inline constexpr bool is_planar_rotation<rotation_2D<C, S>> = true;
}  // namespace detail

/// The rotation with entries of the scalar S.
template <class S, class A, class B>
KTE_INLINE constexpr rotation_2D<S> as(const rotation_2D<A, B>& r) {
  return {as<S>(r.cos), as<S>(r.sin)};
}
/// The inverse rotation.
template <class A, class B>
[[nodiscard]] KTE_INLINE constexpr auto transpose(const rotation_2D<A, B>& r) {
  return rotation_2D{r.cos, -r.sin};
}
template <class A, class B, class C, class D>
KTE_INLINE constexpr auto operator*(const rotation_2D<A, B>& a, const rotation_2D<C, D>& b) {
  return rotation_2D{a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}
template <class A, class B, class X, class Y, class Z>
KTE_INLINE constexpr auto operator*(const rotation_2D<A, B>& r, const vec3<X, Y, Z>& v) {
  return vec3{r.cos * v.x - r.sin * v.y, r.sin * v.x + r.cos * v.y, v.z};
}
template <class A, class B, class X, class Y>
KTE_INLINE constexpr auto operator*(const rotation_2D<A, B>& r, const vec2<X, Y>& v) {
  return vec2{r.cos * v.x - r.sin * v.y, r.sin * v.x + r.cos * v.y};
}

/// The 3x3 rotation matrix.
template <class A, class B>
[[nodiscard]] KTE_INLINE constexpr auto matrix(const rotation_2D<A, B>& r) {
  return mat3{vec3{r.cos, -r.sin, zero}, vec3{r.sin, r.cos, zero}, vec3{zero, zero, one}};
}
template <class RX, class RY, class RZ>
[[nodiscard]] KTE_INLINE constexpr auto matrix(const mat3<RX, RY, RZ>& m) {
  return m;
}
[[nodiscard]] KTE_INLINE constexpr auto matrix(no_rotation) {
  return mat3{vec3{one, zero, zero}, vec3{zero, one, zero}, vec3{zero, zero, one}};
}
/// R A R^T for symmetric A.
template <class A, class B, class... T>
[[nodiscard]] KTE_INLINE constexpr auto congruence(const rotation_2D<A, B>& r, const sym3<T...>& a) {
  return congruence(matrix(r), a);
}

[[nodiscard]] KTE_INLINE constexpr no_rotation transpose(no_rotation) { return {}; }
template <geometric T>
KTE_INLINE constexpr T operator*(no_rotation, const T& x) {
  return x;
}
template <geometric T>
requires(!std::is_same_v<T, no_rotation>) KTE_INLINE constexpr T operator*(const T& x, no_rotation) { return x; }
template <class... T>
[[nodiscard]] KTE_INLINE constexpr auto congruence(no_rotation, const sym3<T...>& a) {
  return a;
}
[[nodiscard]] KTE_INLINE constexpr skip transpose(skip) { return {}; }
[[nodiscard]] KTE_INLINE constexpr skip matrix(skip) { return {}; }

}  // namespace kte
