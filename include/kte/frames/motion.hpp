#pragma once

#include <kte/math/axis.hpp>

/// Motions, poses and wrenches of frames: motion goes outward from the base, loads go inward.
namespace kte {

/// The motion of a frame X.
///   position          p   of its origin, in the axes of its parent, m
///   rotation          R   maps axes of X to axes of the parent
///   velocity          v   time derivative of p, in axes of X, m/s
///   ang_velocity      w   in axes of X, rad/s
///   acceleration      a   second derivative of p (classical, not spatial), in axes of X, m/s^2
///   ang_acceleration  al  in axes of X, rad/s^2
/// Each field is a vector of numbers or typed constants, or `skip` if an algorithm does not need it.
template <class P, class R, class V, class W, class A, class AL>
struct motion {
  P position;
  R rotation;
  V velocity;
  W ang_velocity;
  A acceleration;
  AL ang_acceleration;
};
template <class P, class R, class V, class W, class A, class AL>
motion(P, R, V, W, A, AL) -> motion<P, R, V, W, A, AL>;

/// The pose of a frame in its parent: `rotation` maps axes of the frame to axes of the parent, `position` is that of
/// the origin, in axes of the parent, m.
template <class R, class P>
struct pose {
  R rotation;
  P position;
};
template <class R, class P>
pose(R, P) -> pose<R, P>;

/// The motion of a coordinate: q, m or rad, `q_dot`, `q_ddot`, per second; for angles also `cos` and `sin` of q.
template <class Q, class QD, class QDD, class C, class S>
struct coordinate {
  Q q;
  QD q_dot;
  QDD q_ddot;
  C cos;
  S sin;
};
template <class Q, class QD, class QDD, class C, class S>
coordinate(Q, QD, QDD, C, S) -> coordinate<Q, QD, QDD, C, S>;

/// A wrench on the mechanism at the origin of a frame, in its axes: `force`, N, and `torque`, Nm.
template <class F, class T>
struct wrench {
  using geometry = wrench;
  F force;
  T torque;
};
template <class F, class T>
wrench(F, T) -> wrench<F, T>;

/// No force and no torque: typed zeros.
inline constexpr wrench<zero3, zero3> no_wrench{};

template <class F, class T, class G, class U>
KTE_INLINE constexpr auto operator+(const wrench<F, T>& a, const wrench<G, U>& b) {
  return wrench{a.force + b.force, a.torque + b.torque};
}

template <class F, class T, class G, class U>
KTE_INLINE constexpr auto operator-(const wrench<F, T>& a, const wrench<G, U>& b) {
  return wrench{a.force - b.force, a.torque - b.torque};
}

/// The motion of a frame B that moves by `b` relative to a frame A, which moves by `a`: a*b, exact to second order.
///
///   p  = p_A + R_A p_B,   R = R_A R_B
///   v  = R_B^T (v_A + w_A x p_B) + v_B                                                (1)
///   w  = R_B^T w_A + w_B                                                              (2)
///   a  = R_B^T (a_A + al_A x p_B + w_A x (w_A x p_B)) + 2 (R_B^T w_A) x v_B + a_B     (3)
///   al = R_B^T al_A + (R_B^T w_A) x w_B + al_B                                        (4)
template <class A, class B>
[[nodiscard]] KTE_INLINE constexpr auto compose(const A& a, const B& b) {
  const auto t = transpose(b.rotation);
  const auto& p = b.position;
  const auto& w = a.ang_velocity;
  const auto w_in_b = t * w;
  return motion{a.position + a.rotation * p,
                a.rotation * b.rotation,
                t * (a.velocity + cross(w, p)) + b.velocity,
                w_in_b + b.ang_velocity,
                t * plus_cross(plus_cross(a.acceleration, a.ang_acceleration, p), w, cross(w, p)) +
                    (constant<2>{} * cross(w_in_b, b.velocity) + b.acceleration),
                t * a.ang_acceleration + (cross(w_in_b, b.ang_velocity) + b.ang_acceleration)};
}

/// A wrench at a frame B, transmitted to a frame A in which B has the given pose: the transpose of (1) and (2).
template <class Pose, class F, class T>
[[nodiscard]] KTE_INLINE constexpr auto transmit(const Pose& b_in_a, const wrench<F, T>& at_b) {
  const auto f = b_in_a.rotation * at_b.force;
  return wrench{vec3{f.x, f.y, f.z},  // a copy of f as a whole, g++ 12 would keep in memory
                plus_cross(b_in_a.rotation * at_b.torque, b_in_a.position, f)};
}

/// A frame at rest relative to its parent.
template <class R, class P>
[[nodiscard]] KTE_INLINE constexpr auto at_rest(const R& rotation, const P& position) {
  return motion{position, rotation, zero3{}, zero3{}, zero3{}, zero3{}};
}

/// A linear and an angular quantity, such as velocity and angular velocity, in space; in the plane with zeros.
template <class S = double>
struct linear_angular {
  vec3<S> linear;
  vec3<S> angular;
};

}  // namespace kte
