#pragma once

#include <kte/frames/motion.hpp>
#include <kte/math/plane_rotation.hpp>
#include <kte/math/rigid_body.hpp>

namespace kte {

/// Articulated-body inertia of a frame: the wrench that accelerates it if the joints beyond it are free to move
/// (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 7.1). About the origin of the frame, in its axes. An
/// acceleration a of the origin and an angular acceleration al require the force and torque
///
///   F = M a + H al,    T = H^T a + J al                       (1)
///
/// where M (`linear`, kg) and J (`angular`, kg m^2) are symmetric, and H (`coupling`, kg m) is any matrix.
template <class M, class H, class J>
struct articulated {
  using geometry = articulated;
  M linear;
  H coupling;
  J angular;
};
template <class M, class H, class J>
articulated(M, H, J) -> articulated<M, H, J>;

/// The articulated-body inertia of nothing: typed zeros.
inline constexpr articulated<sym3<zero_t>, mat3<zero3>, sym3<zero_t>> no_articulated{};

/// The wrench of (1) in math/rigid_body.hpp for accelerations a, m/s^2, and al, rad/s^2.
template <class M, class H, class J, class A, class AL>
[[nodiscard]] KTE_INLINE constexpr auto accelerating_wrench(const composite<M, H, J>& b, const A& a, const AL& al) {
  return wrench{b.mass * a + cross(al, b.moment), b.inertia * al + cross(b.moment, a)};
}

/// The articulated-body inertia of rigid bodies: M = m 1, H = -[h]x.
template <class M, class H, class I>
[[nodiscard]] KTE_INLINE constexpr auto to_articulated(const composite<M, H, I>& b) {
  const auto& h = b.moment;
  return articulated{diagonal(b.mass, b.mass, b.mass),
                     mat3{vec3{zero, h.z, -h.y}, vec3{-h.z, zero, h.x}, vec3{h.y, -h.x, zero}}, b.inertia};
}

template <class M, class H, class J, class N, class K, class L>
KTE_INLINE constexpr auto operator+(const articulated<M, H, J>& a, const articulated<N, K, L>& b) {
  return articulated{a.linear + b.linear, a.coupling + b.coupling, a.angular + b.angular};
}

/// The wrench of (1) for accelerations a, m/s^2, and al, rad/s^2.
template <class M, class H, class J, class A, class AL>
[[nodiscard]] KTE_INLINE constexpr auto accelerating_wrench(const articulated<M, H, J>& b, const A& a, const AL& al) {
  return wrench{b.linear * a + b.coupling * al, transpose(b.coupling) * a + b.angular * al};
}

/// The inertia about another point, in the same axes; the origin of the frame is at p seen from it, m. With P = [p]x:
///
///   M' = M,  H' = H - M P,  J' = J + (P H)^T + P H'           (2)
template <class P, class M, class H, class J>
KTE_INLINE constexpr auto shifted(const P& p, const articulated<M, H, J>& b) {
  const auto& m = b.linear;
  const auto& h = b.coupling;
  const auto& j = b.angular;
  const auto f = full(m);
  const mat3 k{plus_cross(h.x, p, f.x), plus_cross(h.y, p, f.y), plus_cross(h.z, p, f.z)};  // row i of M P is m_i x p
  const auto hx = transpose(h);  // columns of H; column i of P H is p x h_i
  const auto kx = transpose(k);
  const vec3 x = plus_cross(vec3{j.xx, j.xy, j.xz}, p, hx.x);  // rows of J + (P H)^T
  const vec3 y = plus_cross(vec3{zero, j.yy, j.yz}, p, hx.y);
  const vec3 z = plus_cross(vec3{zero, zero, j.zz}, p, hx.z);
  const vec3 u = plus_cross(vec3{x.x, zero, zero}, p, kx.x);  // columns of J'
  const vec3 v = plus_cross(vec3{x.y, y.y, zero}, p, kx.y);
  const vec3 w = plus_cross(vec3{x.z, y.z, z.z}, p, kx.z);
  return articulated{m, k, sym3{u.x, v.x, w.x, v.y, w.y, w.z}};
}
/// The inertia in another frame, in which this one has the rotation R and the position p, m.
template <class R, class P, class M, class H, class J>
[[nodiscard]] KTE_INLINE constexpr auto transported(const R& rotation, const P& p, const articulated<M, H, J>& b) {
  const auto r = matrix(rotation);
  return shifted(p, articulated{turned_by(r, b.linear), turned_by(r, b.coupling), turned_by(r, b.angular)});
}

namespace detail {
/// The upper triangle of m - a b^T.
template <class... T, class A, class B>
KTE_INLINE constexpr auto less_dyad(const sym3<T...>& m, const A& a, const B& b) {
  return sym3{m.xx - a.x * b.x, m.xy - a.x * b.y, m.xz - a.x * b.z,
              m.yy - a.y * b.y, m.yz - a.y * b.z, m.zz - a.z * b.z};
}
template <class... R, class A, class B>
KTE_INLINE constexpr auto less_dyad(const mat3<R...>& m, const A& a, const B& b) {
  return mat3{m.x - a.x * b, m.y - a.y * b, m.z - a.z * b};
}
template <class M, class H, class J, class W, class V>
KTE_INLINE constexpr auto less_dyad(const articulated<M, H, J>& m, const W& a, const V& b) {
  return articulated{less_dyad(m.linear, a.force, b.force), less_dyad(m.coupling, a.force, b.torque),
                     less_dyad(m.angular, a.torque, b.torque)};
}
}  // namespace detail

}  // namespace kte
