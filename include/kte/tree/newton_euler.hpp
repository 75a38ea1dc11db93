#pragma once

#include <kte/tree/placement.hpp>

namespace kte::tree {

/// The wrench that a body needs for its motion (Newton and Euler), at its origin:
///
///   f = m (a + al x c + w x (w x c)),   n = I al + w x I w + c x f          (1)
template <class P, class S>
KTE_INLINE dense_wrench<S> wrench_of(const rigid_body<P, vec3<P>, sym3<P>>& b, const body_motion<S>& x) {
  const vec3<S>&w = x.ang_velocity, &al = x.ang_acceleration;
  const vec3<S> f = b.mass * (x.acceleration + (cross(al, b.com) + cross(w, cross(w, b.com))));
  return {f, b.inertia * al + (cross(w, b.inertia * w) + cross(b.com, f))};
}
/// The motions of all bodies, and what they need for them (RNEA, first half): classical accelerations in body axes, as
/// `compose` of frames/motion.hpp. With its parent at w, al, a, the joint at v_J, w_J relative to its seat:
///
///   w_i  = R^T w + w_J,   al_i = R^T al + (R^T w) x w_J + s q_ddot                            (2)
///   a_i  = R^T (a + al x p + w x (w x p)) + 2 (R^T w) x v_J + w_J x v_J + s q_ddot             (3)
///
/// where only poses have v_J together with w_J. Linear velocities on request.
template <bool Velocities, class P, class S>
void move_bodies(const forest<P>& f, memory<P, S>& m) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const placed at{r, m.spots[i]};
    const body_motion<S>& base = m.bodies[static_cast<std::size_t>(r.parent)];
    body_motion<S>& x = m.bodies[bases + i];
    const vec3<S>& p = m.spots[i].position;
    const vec3<S> w = at.in(base.ang_velocity);
    vec3<S> al = at.in(base.ang_acceleration);
    vec3<S> a = at.in(base.acceleration +
                      (cross(base.ang_acceleration, p) + cross(base.ang_velocity, cross(base.ang_velocity, p))));
    const S* const rate = &m.rate[static_cast<std::size_t>(r.first)];
    const S* const change = &m.acceleration[static_cast<std::size_t>(r.first)];
    vec3<S> v{};
    if constexpr (Velocities) v = at.in(base.velocity + cross(base.ang_velocity, p));
    if (r.moves == joint::revolute) {
      al.x += w.y * *rate, al.y -= w.x * *rate, al.z += *change;  // (2)
      x.ang_velocity = {w.x, w.y, w.z + *rate};
    } else {
      vec3<S> v_j{}, w_j{}, a_j{}, al_j{};
      along_axes(r, rate, v_j, w_j);
      along_axes(r, change, a_j, al_j);
      al = al + (cross(w, w_j) + al_j);
      a = a + (S(2) * cross(w, v_j) + cross(w_j, v_j) + a_j);  // (3)
      x.ang_velocity = w + w_j;
      v = v + v_j;
    }
    x.ang_acceleration = al;
    x.acceleration = a;
    if constexpr (Velocities) x.velocity = v;
    x.needs = wrench_of(r.body, x);
  }
}

/// What bodies need goes in along the tree (RNEA, second half); of an axis its power into `force`.
template <class P, class S>
void take_needs(const forest<P>& f, memory<P, S>& m) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const dense_wrench<S>& w = m.bodies[bases + i].needs;
    S* const force = &m.force[static_cast<std::size_t>(r.first)];
    for (int k = 0; k < r.axes; ++k) force[k] = power_along(r, k, w);
    if (r.parent < f.bases) continue;
    const dense_wrench<S> x = placed{r, m.spots[i]}.out(w);
    dense_wrench<S>& to = m.bodies[static_cast<std::size_t>(r.parent)].needs;
    to = {to.force + x.force, to.torque + x.torque};
  }
}

}  // namespace kte::tree
