#pragma once

#include <kte/contract/joint.hpp>
#include <kte/engine/body.hpp>

/// First variations of inverse dynamics, one element at a time. A frame moves by A = (a, al) and w under a wrench W. If
/// everything beyond it is unchanged,
///
///   dW = I (da, dal) + B dw                                       (1)
///
/// I is the composite inertia of its subtree. B is the derivative of W by w: one 3x3 matrix for the force and one for
/// the torque. Linear velocities and positions do not occur, so (1) needs half the operations of the equivalent on
/// spatial vectors (Carpentier and Mansard, RSS 2018; Singh, Russo, Wensing, IEEE RA-L 2022).
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

/// The derivative of w x (w x r) by w: w r^T - 2 r w^T + (w . r) 1.
template <class W, class R>
KTE_INLINE constexpr auto centripetal_by_rate(const W& w, const R& r) {
  return dyad(w, r) - constant<2>{} * dyad(r, w) + diagonal_matrix(dot(w, r));
}

/// B of a body that rotates by w, from W = (... + w x (w x h), ... + w x J w).
template <class M, class H, class J, class W>
KTE_INLINE constexpr auto gyration_of(const composite<M, H, J>& b, const W& w) {
  return gyration{centripetal_by_rate(w, b.moment), cross_matrix(w) * full(b.inertia) - cross_matrix(b.inertia * w)};
}

/// B transformed to the base A of an element, whose end has the pose x and the velocities v_B, w_B (in axes of the
/// end), with
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

/// The change of the motion of a joint's end if the end is displaced along axis s (in its own axes), for a given motion
/// of its base. x: the motion of the joint; at_base: that of its base.
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
/// The change of the motion of a joint's end if the rate along s changes.
template <class Motion, class Axis, class Base>
KTE_INLINE constexpr auto by_rate(const Motion& x, const Axis& s, const Base& at_base) {
  const auto w = transpose(x.rotation) * at_base.ang_velocity;
  return variation{
      s.ang_velocity,
      constant<2>{} * cross(w, s.velocity) + (cross(s.ang_velocity, x.velocity) + cross(x.ang_velocity, s.velocity)),
      cross(w, s.ang_velocity)};
}
/// The change of a wrench at the end if it is displaced along s with the end.
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
/// The sensitivity by the motion of the base A of an element: the transpose of (2) and (3).
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

/// A body, its motion relative to its parent, and its parent.
///   relative()         the motion of its joint (frames/motion.hpp)
///   parent_motion()    w, a, al of the parent
///   load()             the wrench that it and its subtree exert: -W
template <class B>
concept moving_body = engine::body_with_axes<B> && requires(const B& b) {
  b.relative(), b.parent_motion(), b.load();
};
template <int K, class B>
KTE_INLINE constexpr auto axis_motion(const B& b) {
  const auto s = b.template axis<K>();
  return motion{zero3{}, no_rotation{}, s.linear, s.angular, zero3{}, zero3{}};
}

/// Passed to the base: the changes of the wrench by displacement and rate of axis j, and the sensitivity of its force.
template <class Q, class V, class Z>
struct axis_variation {
  Q by_q;
  V by_v;
  Z force;
};
template <class Q, class V, class Z>
axis_variation(Q, V, Z) -> axis_variation<Q, V, Z>;
template <moving_body B, class Q, class V, class Z>
KTE_INLINE constexpr auto seen_by_parent(const B& b, const axis_variation<Q, V, Z>& x) {
  const auto at = b.relative();
  return axis_variation{transmit(at, x.by_q), transmit(at, x.by_v),
                        sensitivity_through(at, b.parent_motion().ang_velocity, x.force)};
}
/// Entries i, j and j, i for the axes i of a body on the path of axis j to the base.
template <class Put>
struct variation_to_parent {
  const Put& put;
  int j;
  template <moving_body B, class X>
  KTE_INLINE constexpr auto operator()(const B& b, const X& x) const {
    entries<0>(b, x);
    return seen_by_parent(b, x);
  }

 private:
  template <int K, class B, class X>
  KTE_INLINE constexpr void entries(const B& b, const X& x) const {
    if constexpr (K < B::axes) {
      const int i = b.first() + K;
      const auto s = axis_motion<K>(b);
      const auto m = power(s, x.force.to_acceleration);
      put.by_q(i, j, power(s, x.by_q));
      put.by_q(j, i, change(x.force, by_displacement(b.relative(), s, b.parent_motion())));
      put.by_v(i, j, power(s, x.by_v));
      put.by_v(j, i, change(x.force, by_rate(b.relative(), s, b.parent_motion())));
      put.by_a(i, j, m), put.by_a(j, i, m);
      entries<K + 1>(b, x);
    }
  }
};
/// For each axis j of a body that carries c: column j and row j of the derivatives of forces by q, v and a, along the
/// path to the base: put.by_q(i, j, x), put.by_v(i, j, x), put.by_a(i, j, x).
template <class Put>
struct variation_columns {
  const Put& put;
  template <moving_body B, class C, class Place>
  KTE_INLINE constexpr auto operator()(const B& b, const C& c, const Place& place) const {
    columns<0>(b, c, place);
    return engine::fresh(c);
  }

 private:
  template <int J, class B, class C, class Place>
  KTE_INLINE constexpr void columns(const B& b, const C& c, const Place& place) const {
    if constexpr (J < B::axes) {
      const int j = b.first() + J;
      const auto s = axis_motion<J>(b);
      const auto by_q = varied_wrench(c.inertia, c.gyration, by_displacement(b.relative(), s, b.parent_motion()));
      const auto by_v = varied_wrench(c.inertia, c.gyration, by_rate(b.relative(), s, b.parent_motion()));
      const auto force = sensitivity_along(c.inertia, c.gyration, s);
      own<0>(b, j, by_q, by_v, force);
      place.ancestors(seen_by_parent(b, axis_variation{by_q - by_displacement(s, b.load()), by_v, force}),
                      variation_to_parent<Put>{put, j});
      columns<J + 1>(b, c, place);
    }
  }
  template <int K, class B, class Q, class V, class Z>
  KTE_INLINE constexpr void own(const B& b, int j, const Q& by_q, const V& by_v, const Z& force) const {
    if constexpr (K < B::axes) {
      const int i = b.first() + K;
      const auto s = axis_motion<K>(b);
      put.by_q(i, j, power(s, by_q)), put.by_v(i, j, power(s, by_v)), put.by_a(i, j, power(s, force.to_acceleration));
      own<K + 1>(b, j, by_q, by_v, force);
    }
  }
};
/// Steps of I and B: the parts fixed to a frame, whose motion is in `more`; to the parent.
struct turning_alone {
  template <class B, class Kept>
  KTE_INLINE constexpr auto operator()(const B& b, const Kept&) const {
    return turning_body{b.composite(), gyration_of(b.composite(), b.more.motion.ang_velocity)};
  }
};
struct turning_to_parent {
  template <moving_body B, class Kept, class C>
  KTE_INLINE constexpr auto operator()(const B& b, const Kept&, const C& c) const {
    const auto x = b.relative();
    return turning_body{transported(x.rotation, x.position, c.inertia),
                        gyration_through(x, b.parent_motion().ang_velocity, c.inertia, c.gyration)};
  }
};
/// Inward: the derivatives of the forces on all axes.
template <class Driver, class Put>
KTE_INLINE constexpr void derivatives_of_forces(const Driver& d, const Put& put) {
  d.template inward<false, engine::nothing, false>(engine::nothing{}, engine::kept_constant<engine::nothing>{},
                                                   turning_alone{}, variation_columns<Put>{put}, turning_to_parent{});
}

}  // namespace kte::detail
