#pragma once

#include <kte/math/constant.hpp>

/// Small vectors, written by components: no expression templates, literal types, any mixture of entries.
namespace kte {

/// A vector x, y in the plane, as users read and write it in a 2D frame.
template <class X = double, class Y = X>
struct vec2 {
  using geometry = vec2;
  X x;
  Y y;
  friend bool operator==(const vec2&, const vec2&) = default;
};
template <class X, class Y>
vec2(X, Y) -> vec2<X, Y>;

/// A vector x, y, z in space. An entry may be a typed constant: `vec3{zero, zero, 0.36}`.
template <class X = double, class Y = X, class Z = Y>
struct vec3 {
  using geometry = vec3;
  X x;
  Y y;
  Z z;
  friend bool operator==(const vec3&, const vec3&) = default;
};
template <class X, class Y, class Z>
vec3(X, Y, Z) -> vec3<X, Y, Z>;

/// The zero vector as a type.
using zero3 = vec3<zero_t>;

/// A vector of length d along an axis, m; the other two components are typed zeros and cost nothing.
template <variable T>
[[nodiscard]] constexpr auto along_x(T d) {
  return vec3{real(d), zero, zero};
}
/// A vector of length d along y, m.
template <variable T>
[[nodiscard]] constexpr auto along_y(T d) {
  return vec3{zero, real(d), zero};
}
/// A vector of length d along z, m.
template <variable T>
[[nodiscard]] constexpr auto along_z(T d) {
  return vec3{zero, zero, real(d)};
}

namespace detail {
/// A position in the plane, as a user writes it, as a vector of space with a typed zero.
template <entry X, entry Y>
constexpr auto planar(const vec2<X, Y>& v) {
  return vec3{real(v.x), real(v.y), zero};
}
template <entry X, entry Y, entry Z>
constexpr auto planar(const vec3<X, Y, Z>& v) {
  static_assert(std::is_same_v<Z, zero_t>, "kte: a position in the plane has no z: use along_x, along_y or vec2{x, y}");
  return vec3{real(v.x), real(v.y), zero};
}
}  // namespace detail

/// The vector with entries of the scalar S.
template <class S, class X, class Y>
KTE_INLINE constexpr vec2<S> as(const vec2<X, Y>& v) {
  return {as<S>(v.x), as<S>(v.y)};
}
template <class S, class X, class Y, class Z>
KTE_INLINE constexpr vec3<S> as(const vec3<X, Y, Z>& v) {
  return {as<S>(v.x), as<S>(v.y), as<S>(v.z)};
}

template <class A, class B, class C, class D>
KTE_INLINE constexpr auto operator+(const vec2<A, B>& a, const vec2<C, D>& b) {
  return vec2{a.x + b.x, a.y + b.y};
}
template <class A, class B, class C, class D>
KTE_INLINE constexpr auto operator-(const vec2<A, B>& a, const vec2<C, D>& b) {
  return vec2{a.x - b.x, a.y - b.y};
}
template <entry S, class A, class B>
KTE_INLINE constexpr auto operator*(const S& s, const vec2<A, B>& v) {
  return vec2{s * v.x, s * v.y};
}

template <class A, class B, class C, class D, class E, class F>
KTE_INLINE constexpr auto operator+(const vec3<A, B, C>& a, const vec3<D, E, F>& b) {
  return vec3{a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B, class C, class D, class E, class F>
KTE_INLINE constexpr auto operator-(const vec3<A, B, C>& a, const vec3<D, E, F>& b) {
  return vec3{a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B, class C>
KTE_INLINE constexpr auto operator-(const vec3<A, B, C>& v) {
  return vec3{-v.x, -v.y, -v.z};
}
template <entry S, class A, class B, class C>
KTE_INLINE constexpr auto operator*(const S& s, const vec3<A, B, C>& v) {
  return vec3{s * v.x, s * v.y, s * v.z};
}
template <entry S, class A, class B, class C>
KTE_INLINE constexpr auto operator*(const vec3<A, B, C>& v, const S& s) {
  return s * v;
}

/// a x b
template <class A, class B, class C, class D, class E, class F>
[[nodiscard]] KTE_INLINE constexpr auto cross(const vec3<A, B, C>& a, const vec3<D, E, F>& b) {
  return vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
[[nodiscard]] KTE_INLINE constexpr skip cross(skip, const T&) {
  return {};
}
template <not_skip T>
[[nodiscard]] KTE_INLINE constexpr skip cross(const T&, skip) {
  return {};
}

/// to += a x b, for entries of any kind: also several numbers in a register.
template <class To, class A, class B>
KTE_INLINE constexpr void add_cross(To& to, const A& a, const B& b) {
  to.x += a.y * b.z - a.z * b.y, to.y += a.z * b.x - a.x * b.z, to.z += a.x * b.y - a.y * b.x;
}
/// v + a x b, by two fused multiply-adds per component where the CPU has them.
template <class V, class A, class B>
[[nodiscard]] KTE_INLINE constexpr auto plus_cross(const V& v, const A& a, const B& b) {
  if constexpr (std::is_same_v<V, skip> || std::is_same_v<A, skip> || std::is_same_v<B, skip>) {
    return v + cross(a, b);
  } else {
    return vec3{v.x + a.y * b.z - a.z * b.y, v.y + a.z * b.x - a.x * b.z, v.z + a.x * b.y - a.y * b.x};
  }
}

/// a . b
template <class A, class B, class C, class D, class E, class F>
[[nodiscard]] KTE_INLINE constexpr auto dot(const vec3<A, B, C>& a, const vec3<D, E, F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B, class C, class D>
[[nodiscard]] KTE_INLINE constexpr auto dot(const vec2<A, B>& a, const vec2<C, D>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class T>
[[nodiscard]] KTE_INLINE constexpr skip dot(skip, const T&) {
  return {};
}
template <not_skip T>
[[nodiscard]] KTE_INLINE constexpr skip dot(const T&, skip) {
  return {};
}

}  // namespace kte
