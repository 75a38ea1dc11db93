#pragma once

#include <kte/detail/call.hpp>
#include <kte/math/axis.hpp>

namespace kte {

/// Mass properties of a rigid body.
///   mass       kg
///   com        centre of mass in the axes of its frame, m
///   inertia    about the centre of mass, in the axes of the frame, kg m^2
///   published  see `as_published`
/// Elements reject a body that is not physically realizable. `rigid_body{...}.as_published()` is checked less: it must
/// be finite, with a mass that is not negative. It is for tables of robots with measured or rounded inertias.
template <class M = double, class C = vec3<>, class I = sym3<>>
struct rigid_body {
  M mass;
  C com;
  I inertia;
  bool published = false;
  constexpr rigid_body as_published() const { return {mass, com, inertia, true}; }
  friend bool operator==(const rigid_body&, const rigid_body&) = default;
};
template <class M, class C, class I>
rigid_body(M, C, I) -> rigid_body<M, C, I>;

/// A mass at the origin of its frame, kg. The zeros of its inertia are typed and cost nothing.
template <variable T>
[[nodiscard]] constexpr auto point_mass(T mass) {
  return rigid_body{real(mass), zero3{}, sym3<zero_t>{}};
}
/// A mass, kg, at `com`, m, in the axes of its frame.
template <variable T, class X, class Y, class Z>
[[nodiscard]] constexpr auto point_mass(T mass, const vec3<X, Y, Z>& com) {
  return rigid_body{real(mass), com, sym3<zero_t>{}};
}
template <class... None>
requires(sizeof...(None) == 0) constexpr auto point_mass(const None&...) {
  static_assert(detail::fit<None...>, "kte: call it as point_mass(mass) or point_mass(mass, com)");
  return point_mass(1.0);
}
/// A body in the plane: mass, kg, moment of inertia about the axis normal to the plane through the centre of mass, kg
/// m^2, and centre of mass, m: `vec2{0.1, 0.2}`, `along_x(0.1)`.
template <variable T, variable U, class X = zero_t, class Y = zero_t>
[[nodiscard]] constexpr auto planar_body(T mass, U inertia, const vec3<X, Y, zero_t>& com = {}) {
  return rigid_body{real(mass), com, diagonal(zero, zero, real(inertia))};
}
template <variable T, variable U, entry X, entry Y>
[[nodiscard]] constexpr auto planar_body(T mass, U inertia, const vec2<X, Y>& com) {
  return planar_body(mass, inertia, detail::planar(com));
}

/// The body with numbers converted to scalars of type S.
template <class S, class M, class C, class J>
constexpr auto lifted(const rigid_body<M, C, J>& b) {
  const auto& c = b.com;
  const auto& i = b.inertia;
  return rigid_body{
      lifted<S>(b.mass), vec3{lifted<S>(c.x), lifted<S>(c.y), lifted<S>(c.z)},
      sym3{lifted<S>(i.xx), lifted<S>(i.xy), lifted<S>(i.xz), lifted<S>(i.yy), lifted<S>(i.yz), lifted<S>(i.zz)}};
}

/// The inertia of one or more rigid bodies, about the origin of a frame and in its axes:
///
///   mass m, kg,  first moment h = m c, kg m,  inertia I = I_c + m (|c|^2 1 - c c^T), kg m^2
///
/// Acceleration a of the origin and angular acceleration al need the force and torque
///
///   F = m a + al x h,    T = I al + h x a                       (1)
template <class M, class H, class I>
struct composite {
  using geometry = composite;
  M mass;
  H moment;
  I inertia;
};
template <class M, class H, class I>
composite(M, H, I) -> composite<M, H, I>;

/// No inertia: typed zeros.
inline constexpr composite<zero_t, zero3, sym3<zero_t>> no_mass{};

namespace detail {
/// I -> I + 2 (p.u) 1 - p u^T - u p^T: the change of an inertia when its point of reference moves by p and
/// u = h + (m/2) p.
template <class... T, class P, class U>
KTE_INLINE constexpr auto shifted(const sym3<T...>& i, const P& p, const U& u) {
  constexpr constant<2> two{};
  const auto xx = p.x * u.x;
  const auto yy = p.y * u.y;
  const auto zz = p.z * u.z;
  return sym3{i.xx + two * (yy + zz), i.xy - (p.x * u.y + p.y * u.x), i.xz - (p.x * u.z + p.z * u.x),
              i.yy + two * (zz + xx), i.yz - (p.y * u.z + p.z * u.y), i.zz + two * (xx + yy)};
}
template <class P, class U>
KTE_INLINE constexpr skip shifted(skip, const P&, const U&) {
  return {};
}
template <class T>
KTE_INLINE constexpr auto half(const T& x) {
  if constexpr (variable<T>) {
    return T(x * T(0.5));
  } else {
    static_assert(std::is_same_v<T, zero_t>, "kte: half of a typed constant other than zero");
    return x;
  }
}
}  // namespace detail

/// The kinetic energy of a body whose frame has velocity v, m/s, and angular velocity w, rad/s, in its own axes, J:
///
///   T = m |v + w x c|^2 / 2 + w . I w / 2
template <class M, class C, class I, class V, class W>
[[nodiscard]] KTE_INLINE constexpr auto kinetic_energy_of_body(const rigid_body<M, C, I>& b, const V& v, const W& w) {
  const auto v_c = plus_cross(v, w, b.com);
  return detail::half(b.mass * dot(v_c, v_c) + dot(w, b.inertia * w));
}

/// The composite inertia of one body.
template <class M, class C, class I>
[[nodiscard]] KTE_INLINE constexpr auto to_composite(const rigid_body<M, C, I>& b) {
  const auto h = b.mass * b.com;
  return composite{b.mass, h, detail::shifted(b.inertia, b.com, detail::half(b.mass) * b.com)};
}

/// The inertia in another frame, in which this one has the rotation r and the position p, m.
template <class R, class P, class M, class H, class I>
[[nodiscard]] KTE_INLINE constexpr auto transported(const R& r, const P& p, const composite<M, H, I>& b) {
  const auto h = r * b.moment;
  return composite{b.mass, h + b.mass * p, detail::shifted(congruence(r, b.inertia), p, h + detail::half(b.mass) * p)};
}

template <class M, class H, class I, class N, class K, class J>
KTE_INLINE constexpr auto operator+(const composite<M, H, I>& a, const composite<N, K, J>& b) {
  return composite{a.mass + b.mass, a.moment + b.moment, a.inertia + b.inertia};
}

}  // namespace kte
