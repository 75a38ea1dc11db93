#pragma once

#include <kte/contract/joint.hpp>
#include <kte/engine/body.hpp>

/// The wrench W of a body and its subtree as a function of the angular velocity w of the body, if everything beyond it
/// is unchanged:
///
///   dW = I (da, dal) + B dw                                       (1)
///
/// I is the composite inertia. B is the derivative of W by w: one 3x3 matrix for the force and one for the torque.
/// Linear velocities and positions do not occur, so (1) needs half the operations of the equivalent on spatial vectors
/// (Carpentier and Mansard, RSS 2018; Singh, Russo, Wensing, IEEE RA-L 2022).
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

/// A body, its motion relative to its parent, and its parent.
///   relative()         the motion of its joint (frames/motion.hpp)
///   parent_motion()    w, a, al of the parent
///   load()             the wrench that it and its subtree exert: -W
template <class B>
concept moving_body = engine::body_with_axes<B> && requires(const B& b) {
  b.relative(), b.parent_motion(), b.load();
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

}  // namespace kte::detail
