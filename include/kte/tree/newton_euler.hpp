#pragma once

#include <kte/tree/placement.hpp>

namespace kte::tree {

/// The wrench that a body needs for its motion (Newton and Euler), at its origin:
///
///   f = m (a + al x c + w x (w x c)),   n = I al + w x I w + c x f          (1)
template <class P, class S>
KTE_INLINE dense_wrench<S> wrench_of(const rigid_body<P, vec3<P>, sym3<P>>& b, const vec3<S>& a, const vec3<S>& w,
                                     const vec3<S>& al) {
  const vec3<S> f = b.mass * (a + (cross(al, b.com) + cross(w, cross(w, b.com))));
  return {f, b.inertia * al + (cross(w, b.inertia * w) + cross(b.com, f))};
}
/// (1) to (3) of a body of several axes, from the motion of its parent in its place. Apart, that what is seldom needed
/// does not take registers from the rest.
template <bool Velocities, class P, class S>
[[gnu::noinline]] void move_by_several(const record<P>& r, const spot<S>& at, const S* rate, const S* change,
                                       body_motion<S>& x) {
  const placed seat{r, at};
  const vec3<S> w = seat.in_of_several(x.ang_velocity);
  vec3<S> v_j{}, w_j{}, a_j{}, al_j{};
  along_axes(r, rate, v_j, w_j);
  along_axes(r, change, a_j, al_j);
  const vec3<S> swept = cross(x.ang_velocity, at.position);
  if constexpr (Velocities) x.velocity = seat.in_of_several(x.velocity + swept) + v_j;
  x.acceleration =
      seat.in_of_several(x.acceleration + (cross(x.ang_acceleration, at.position) + cross(x.ang_velocity, swept))) +
      (S(2) * cross(w, v_j) + cross(w_j, v_j) + a_j);
  x.ang_acceleration = seat.in_of_several(x.ang_acceleration) + (cross(w, w_j) + al_j);
  x.ang_velocity = w + w_j;
  x.needs = wrench_of(r.body, x.acceleration, x.ang_velocity, x.ang_acceleration);
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
  const int bases = f.bases;
  // The motion of the body before stays in registers: most bodies stand on it.
  vec3<S> v{}, w{}, a{}, al{};
  int at_hand = -1;
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const placed at{r, m.spots[i]};
    if (r.parent != at_hand) {
      const body_motion<S>& base = m.bodies[static_cast<std::size_t>(r.parent)];
      w = base.ang_velocity, al = base.ang_acceleration, a = base.acceleration;
      if constexpr (Velocities) v = base.velocity;
    }
    at_hand = bases + static_cast<int>(i);
    const S* const rate = &m.rate[static_cast<std::size_t>(r.first)];
    const S* const change = &m.acceleration[static_cast<std::size_t>(r.first)];
    body_motion<S>& x = m.bodies[static_cast<std::size_t>(at_hand)];
    if (r.moves == joint::several) [[unlikely]] {
      x = {v, w, a, al, {}};
      move_by_several<Velocities>(r, m.spots[i], rate, change, x);
      w = x.ang_velocity, al = x.ang_acceleration, a = x.acceleration;
      if constexpr (Velocities) v = x.velocity;
      continue;
    }
    const vec3<S>& p = m.spots[i].position;
    if constexpr (Velocities) v = at.in(v + cross(w, p));
    a = at.in(a + (cross(al, p) + cross(w, cross(w, p))));
    al = at.in(al);
    w = at.in(w);
    if (r.moves == joint::revolute) {
      al.x += w.y * *rate, al.y -= w.x * *rate, al.z += *change;  // (2)
      w.z += *rate;
    } else {
      vec3<S> v_j{}, w_j{}, a_j{}, al_j{};
      along_axes(r, rate, v_j, w_j);
      along_axes(r, change, a_j, al_j);
      al = al + (cross(w, w_j) + al_j);
      a = a + (S(2) * cross(w, v_j) + cross(w_j, v_j) + a_j);  // (3)
      w = w + w_j;
      if constexpr (Velocities) v = v + v_j;
    }
    x.ang_velocity = w, x.ang_acceleration = al, x.acceleration = a;
    if constexpr (Velocities) x.velocity = v;
    x.needs = wrench_of(r.body, a, w, al);
  }
}

/// What bodies need for motions that are known: after `accelerate`.
template <class P, class S>
void need_for_motion(const forest<P>& f, memory<P, S>& m) {
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    body_motion<S>& x = m.bodies[static_cast<std::size_t>(f.bases) + i];
    x.needs = wrench_of(f.records[i].body, x.acceleration, x.ang_velocity, x.ang_acceleration);
  }
}

/// Apart, that what is seldom needed does not take registers from the rest.
template <class P, class S>
[[gnu::noinline]] void take_powers(const record<P>& r, vec3<S> force, vec3<S> torque, S* power) {
  powers_along(r, dense_wrench<S>{force, torque}, r.axes, [power](int k, const S& x) { power[k] = x; });
}
/// What bodies need goes in along the tree (RNEA, second half); of an axis its power into `force`.
template <class P, class S>
void take_needs(const forest<P>& f, memory<P, S>& m) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  vec3<S> force{}, torque{};  // of the body at hand, in registers
  bool at_hand = false;
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    dense_wrench<S>& needs = m.bodies[bases + i].needs;
    if (at_hand)
      needs = {force, torque};
    else
      force = needs.force, torque = needs.torque;
    S* const power = &m.force[static_cast<std::size_t>(r.first)];
    if (r.moves == joint::revolute) [[likely]]
      *power = torque.z;
    else
      take_powers(r, force, torque, power);
    at_hand = false;
    if (r.parent < f.bases) continue;
    const placed at{r, m.spots[i]};
    dense_wrench<S>& to = m.bodies[static_cast<std::size_t>(r.parent)].needs;
    force = at.out(force);
    torque = to.torque + (at.out(torque) + cross(m.spots[i].position, force));
    force = to.force + force;
    at_hand = static_cast<std::size_t>(r.parent) + 1 == bases + i;
    if (!at_hand) to = {force, torque};
  }
}

}  // namespace kte::tree
