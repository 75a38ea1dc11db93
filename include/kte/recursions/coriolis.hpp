#pragma once

#include <kte/recursions/world_joints.hpp>

/// The matrix C(q, v) of Coriolis and centrifugal forces by Christoffel symbols: dM/dt - 2 C is skew-symmetric, and C v
/// are the forces (Echeandia, Wensing, J. Computational Nonlinear Dynamics 16(9), 2021, algorithm 1). All quantities
/// are in the axes of the world at the origin of each body, so that accuracy does not depend on the distance from the
/// origin of the world.
namespace kte::engine {

/// [a]x [b]x
template <class S>
KTE_INLINE mat3<vec3<S>> cross_twice(const vec3<S>& a, const vec3<S>& b) {
  const S d = dot(a, b);
  mat3<vec3<S>> m{b.x * a, b.y * a, b.z * a};
  m.x.x -= d, m.y.y -= d, m.z.z -= d;
  return m;
}
/// [w]x J - J [w]x - [J w]x of a symmetric J, which is
///
///   [w]x (2 J - tr J)
///
/// for [J w]x is tr(J) [w]x - J [w]x - [w]x J.
template <class S>
KTE_INLINE mat3<vec3<S>> gyroscopic(const vec3<S>& w, const sym3<S>& j) {
  const S xy = j.xy + j.xy, xz = j.xz + j.xz, yz = j.yz + j.yz;
  const sym3<S> twice{j.xx - j.yy - j.zz, xy, xz, j.yy - j.zz - j.xx, yz, j.zz - j.xx - j.yy};
  return as<S>(cross_matrix(w) * full(twice));
}
/// A body with all bodies that it carries: mass, moment h, inertia I; and the matrix B of (2), given by P and N.
template <class S>
struct coriolis_body {
  composite<S, vec3<S>, sym3<S>> carried{};
  vec3<S> momentum{};       ///< P
  mat3<vec3<S>> turning{};  ///< N
};

/// The rate of change of an axis s that is constant in a body of velocity v, w:
///
///   ds/dt:   linear part w x s_v + v x s_w,   angular part w x s_w          (1)
template <class S>
KTE_INLINE joint_axis<S> change_of(const joint_axis<S>& s, const vec3<S>& v, const vec3<S>& w) {
  return {cross(w, s.linear) + cross(v, s.angular), cross(w, s.angular)};
}
/// A body at this velocity, with the momentum P = m v + w x h:
///
///   B s = (s_w x P,  N s_w),   N = ([w]x I - I [w]x - [I w]x) / 2 - [h]x [v]x          (2)
template <class S>
KTE_INLINE coriolis_body<S> coriolis_of(const composite<S, vec3<S>, sym3<S>>& own, const vec3<S>& v, const vec3<S>& w) {
  const auto& [mass, h, i] = own;
  return {own, mass * v + cross(w, h), gyroscopic(vec3<S>(S(1) / S(2) * w), i) - cross_twice(h, v)};
}

/// The wrenches of an axis s of a body: I^c ds/dt + B^c s and I^c s, and the torque of B^c^T s.
template <class S>
struct coriolis_wrenches_of {
  wrench<vec3<S>, vec3<S>> by_change, by_axis;
  vec3<S> turning;
};
template <class S>
KTE_INLINE coriolis_wrenches_of<S> coriolis_wrenches(const coriolis_body<S>& b, const joint_axis<S>& s,
                                                     const joint_axis<S>& change) {
  const auto& [mass, h, inertia] = b.carried;
  return {{mass * change.linear + cross(change.angular, h) + cross(s.angular, b.momentum),
           inertia * change.angular + cross(h, change.linear) + b.turning * s.angular},
          {mass * s.linear + cross(s.angular, h), inertia * s.angular + cross(h, s.linear)},
          transpose(b.turning) * s.angular + cross(b.momentum, s.linear)};
}
/// Adds a body to its parent, from whose origin d leads to its own. Wrenches f, n and B pass inward as
///
///   n + d x f,   N - [d]x [P]x          (5)
template <class S>
KTE_INLINE void carry_coriolis_body(const coriolis_body<S>& b, const vec3<S>& d, coriolis_body<S>& to) {
  const auto& [mass, h, inertia] = b.carried;
  to.carried = {to.carried.mass + mass, to.carried.moment + h + mass * d,
                to.carried.inertia + as<S>(kte::detail::shifted(inertia, d, h + kte::detail::half(mass) * d))};
  to.momentum = to.momentum + b.momentum;
  to.turning = to.turning + b.turning - cross_twice(d, b.momentum);
}

/// With I^c and B^c of all bodies beyond axis k, for k and all axes j before it,
///
///   C_jk = s_j . (I^c ds_k/dt + B^c s_k),   C_kj = ds_j/dt . (I^c s_k) + s_j . (B^c^T s_k)          (3)
///   M_jk = s_j . (I^c s_k)                                                                          (4)
///
/// by put(j, k, C_jk, M_jk), once for each ordered pair of axes that move a body together.
///
/// `changes`: (1) by axis. `bodies`: the results of (2) for each body alone; they are changed. For loops over body
/// nodes tree/coriolis.hpp has the wrenches of several axes in a register.
template <class S, world_joints T, class Put>
void coriolis_terms(const T& t, const joint_axis<S>* changes, coriolis_body<S>* bodies, const Put& put) {
  for (int i = t.count(); i-- > 0;) {
    const int end = t.first(i) + t.axes(i);
    for (int k = t.first(i); k < end; ++k) {
      auto [first, second, third] = coriolis_wrenches(bodies[i], t.axis(k), changes[k]);
      for (int j = t.first(i); j < end; ++j) put(j, k, power(t.axis(j), first), power(t.axis(j), second));  // (3), (4)
      for (int at = i; t.parent(at) >= 0;) {
        const vec3<S>& d = t.step(at);
        first.torque = first.torque + cross(d, first.force), second.torque = second.torque + cross(d, second.force);
        at = t.parent(at);
        for (int j = t.first(at); j < t.first(at) + t.axes(at); ++j) {
          const S mass_jk = power(t.axis(j), second);
          put(j, k, power(t.axis(j), first), mass_jk);
          put(k, j, S(power(changes[j], second) + dot(t.axis(j).angular, third)), mass_jk);
        }
      }
    }
    if (t.parent(i) >= 0) carry_coriolis_body(bodies[i], t.step(i), bodies[t.parent(i)]);
  }
}

}  // namespace kte::engine
