#pragma once

#include <kte/contract/joint.hpp>

/// First variations of inverse dynamics, one element at a time. A frame moves by A = (a, al) and w; whoever carries it
/// pushes it by a wrench W. With everything beyond it left as it is,
///
///   dW = I (da, dal) + B dw                                       (1)
///
/// I: the composite inertia of what it carries. B: how W changes with w, one 3x3 matrix for the force and one for the
/// torque. Linear velocities and positions do not matter, which makes (1) half of what it is on spatial vectors
/// (Carpentier and Mansard, RSS 2018; Singh, Russo, Wensing, IEEE RA-L 2022), to which it is otherwise equal.
namespace kte::detail {

/// B of (1).
template <class F, class T>
struct gyration {
  using geometry = gyration;
  F force;
  T torque;
};
template <class F, class T>
gyration(F, T) -> gyration<F, T>;
template <class F, class T, class G, class U>
KTE_INLINE constexpr auto operator+(const gyration<F, T>& a, const gyration<G, U>& b) {
  return gyration{a.force + b.force, a.torque + b.torque};
}
inline constexpr gyration<mat3<zero3>, mat3<zero3>> no_gyration{};

/// I and B.
template <class C, class G>
struct turning_body {
  using geometry = turning_body;
  C inertia;
  G gyration;
};
template <class C, class G>
turning_body(C, G) -> turning_body<C, G>;
template <class C, class G, class D, class H>
KTE_INLINE constexpr auto operator+(const turning_body<C, G>& a, const turning_body<D, H>& b) {
  return turning_body{a.inertia + b.inertia, a.gyration + b.gyration};
}
inline constexpr turning_body no_turning_body{no_mass, no_gyration};

/// The derivative of w x (w x r) by w: w r^T - 2 r w^T + (w . r) 1.
template <class W, class R>
KTE_INLINE constexpr auto centripetal_by_rate(const W& w, const R& r) {
  return dyad(w, r) - constant<2>{} * dyad(r, w) + diagonal_matrix(dot(w, r));
}

/// Of a body that turns by w: from W = (... + w x (w x h), ... + w x J w).
template <class M, class H, class J, class W>
KTE_INLINE constexpr auto gyration_of(const composite<M, H, J>& b, const W& w) {
  return gyration{centripetal_by_rate(w, b.moment), cross_matrix(w) * full(b.inertia) - cross_matrix(b.inertia * w)};
}

/// B seen from the base A of an element, in which its end stands at x and moves by v_B, w_B (in axes of the end), with
///
///   dal_E = R^T dal_A + R^T dw_A x w_B                                                                     (2)
///   da_E = R^T (da_A + dal_A x p + K dw_A) + 2 R^T dw_A x v_B,   K = centripetal_by_rate(w_A, p)         (3)
template <class Motion, class W, class M, class H, class J, class F, class T>
KTE_INLINE constexpr auto gyration_through(const Motion& x, const W& w_a, const composite<M, H, J>& b,
                                           const gyration<F, T>& g) {
  const auto r = matrix(x.rotation);
  const auto t = transpose(r);
  const auto w_b = x.rotation * x.ang_velocity;
  const auto v_b = x.rotation * x.velocity;
  const auto h = x.rotation * b.moment;
  const auto k = centripetal_by_rate(w_a, x.position) - constant<2>{} * cross_matrix(v_b);
  const auto turned = full(congruence(x.rotation, b.inertia)) * cross_matrix(w_b);
  const auto force = r * (g.force * t) + (b.mass * k + cross_matrix(h) * cross_matrix(w_b));
  return gyration{force, r * (g.torque * t) + (cross_matrix(h) * k - turned) + cross_matrix(x.position) * force};
}

/// A change of motion of a frame.
template <class W, class A, class AL>
struct variation {
  W ang_velocity;
  A acceleration;
  AL ang_acceleration;
};
template <class W, class A, class AL>
variation(W, A, AL) -> variation<W, A, AL>;

/// (1)
template <class C, class G, class V>
KTE_INLINE constexpr auto varied_wrench(const C& c, const G& b, const V& d) {
  const auto w =
      accelerating_wrench(c, motion{zero3{}, no_rotation{}, d.acceleration, d.ang_acceleration, zero3{}, zero3{}});
  return wrench{w.force + b.force * d.ang_velocity, w.torque + b.torque * d.ang_velocity};
}

/// How the motion of the end of a joint changes where the end is displaced along axis s (in its own axes), that of the
/// base being given. x: the motion of the joint; at_base: that of its base.
template <class Motion, class Axis, class Base>
KTE_INLINE constexpr auto by_displacement(const Motion& x, const Axis& s, const Base& at_base) {
  const auto t = transpose(x.rotation);
  const auto w = t * at_base.ang_velocity;
  const auto al = t * at_base.ang_acceleration;
  const auto a = t * (at_base.acceleration + (cross(at_base.ang_acceleration, x.position) +
                                              cross(at_base.ang_velocity, cross(at_base.ang_velocity, x.position))));
  const auto dw = cross(w, s.ang_velocity);
  return variation{dw,
                   cross(a, s.ang_velocity) + (cross(al, s.velocity) + cross(w, cross(w, s.velocity))) +
                       constant<2>{} * cross(dw, x.velocity),
                   cross(al, s.ang_velocity) + cross(dw, x.ang_velocity)};
}
/// The same where the rate along s changes.
template <class Motion, class Axis, class Base>
KTE_INLINE constexpr auto by_rate(const Motion& x, const Axis& s, const Base& at_base) {
  const auto w = transpose(x.rotation) * at_base.ang_velocity;
  return variation{
      s.ang_velocity,
      constant<2>{} * cross(w, s.velocity) + (cross(s.ang_velocity, x.velocity) + cross(x.ang_velocity, s.velocity)),
      cross(w, s.ang_velocity)};
}
/// A wrench at the end that is displaced with it along s: by how much it changes where it was.
template <class Axis, class F, class T>
KTE_INLINE constexpr auto by_displacement(const Axis& s, const wrench<F, T>& w) {
  return wrench{cross(s.ang_velocity, w.force), cross(s.ang_velocity, w.torque) + cross(s.velocity, w.force)};
}

/// A number that changes with the motion of a frame: dn = f . da + t . dal + g . dw.
template <class F, class T, class G>
struct sensitivity {
  wrench<F, T> to_acceleration;
  G to_rate;
};
template <class F, class T, class G>
sensitivity(wrench<F, T>, G) -> sensitivity<F, T, G>;

template <class Z, class V>
KTE_INLINE constexpr auto change(const Z& z, const V& d) {
  return dot(z.to_acceleration.force, d.acceleration) + dot(z.to_acceleration.torque, d.ang_acceleration) +
         dot(z.to_rate, d.ang_velocity);
}
/// The power of W along axis s.
template <class C, class G, class Axis>
KTE_INLINE constexpr auto sensitivity_along(const C& c, const G& b, const Axis& s) {
  return sensitivity{accelerating_wrench(c, s), transpose(b.force) * s.velocity + transpose(b.torque) * s.ang_velocity};
}
/// The same number by the motion of the base A of an element: the transpose of (2) and (3).
template <class Motion, class W, class Z>
KTE_INLINE constexpr auto sensitivity_through(const Motion& x, const W& w, const Z& z) {
  const auto f = x.rotation * z.to_acceleration.force;
  const auto t = x.rotation * z.to_acceleration.torque;
  const auto& p = x.position;
  const auto w_b = x.rotation * x.ang_velocity;
  const auto v_b = x.rotation * x.velocity;
  const auto by_k = dot(w, f) * p - constant<2>{} * (dot(p, f) * w) + dot(w, p) * f;
  return sensitivity{transmit(x, z.to_acceleration),
                     x.rotation * z.to_rate + by_k + (cross(w_b, t) + constant<2>{} * cross(v_b, f))};
}

}  // namespace kte::detail
