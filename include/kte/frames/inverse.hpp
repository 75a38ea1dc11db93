#pragma once

#include <kte/frames/motion.hpp>

/// Poses and motions the other way round, and in other axes.
namespace kte {

/// The pose b given relative to the pose a, relative to the parent of a: R = R_A R_B, p = p_A + R_A p_B.
template <class R, class P, class Q, class U>
[[nodiscard]] KTE_INLINE constexpr auto compose(const pose<R, P>& a, const pose<Q, U>& b) {
  return pose{a.rotation * b.rotation, a.position + a.rotation * b.position};
}
/// The pose of the parent relative to the frame: rotation R^T, position -R^T p.
template <class R, class P>
[[nodiscard]] KTE_INLINE constexpr auto inverse(const pose<R, P>& a) {
  const auto t = transpose(a.rotation);
  return pose{t, -(t * a.position)};
}
/// A point of the frame, m, in axes of its parent: p + R x.
template <class R, class P, class X, class Y, class Z>
[[nodiscard]] KTE_INLINE constexpr auto to_parent(const pose<R, P>& a, const vec3<X, Y, Z>& point) {
  return a.position + a.rotation * point;
}

/// The motion of the parent relative to a frame A, with r = R^T p:
///
///   p' = -r,  R' = R^T
///   v' = R (w x r - v)                                            (1)
///   w' = -R w,  al' = -R al                                       (2)
///   a' = R (al x r - w x (w x r) + 2 w x v - a)                   (3)
///
/// compose(a, inverse(a)) is the frame itself, at rest.
template <class A>
[[nodiscard]] KTE_INLINE constexpr auto inverse(const A& a) {
  const auto t = transpose(a.rotation);
  const auto r = t * a.position;
  const auto& w = a.ang_velocity;
  const auto& v = a.velocity;
  return motion{-r,
                t,
                a.rotation * (cross(w, r) - v),
                -(a.rotation * w),
                a.rotation * (cross(a.ang_acceleration, r) - cross(w, cross(w, r)) + constant<2>{} * cross(w, v) -
                              a.acceleration),
                -(a.rotation * a.ang_acceleration)};
}

/// The motion of frame B relative to frame A; both are given relative to one parent.
template <class A, class B>
[[nodiscard]] KTE_INLINE constexpr auto relative(const A& a, const B& b) {
  return compose(inverse(a), b);
}

/// The motion with velocities and accelerations in the axes of the parent; for a frame of a chain, those of the world.
template <class A>
[[nodiscard]] KTE_INLINE constexpr auto in_parent_axes(const A& a) {
  const auto& R = a.rotation;
  return motion{a.position, R, R * a.velocity, R * a.ang_velocity, R * a.acceleration, R * a.ang_acceleration};
}
/// A wrench in the axes of a frame, in the axes of its parent; `rotation` is that of the frame.
template <class R, class F, class T>
[[nodiscard]] KTE_INLINE constexpr auto in_parent_axes(const R& rotation, const wrench<F, T>& w) {
  return wrench{rotation * w.force, rotation * w.torque};
}

}  // namespace kte
