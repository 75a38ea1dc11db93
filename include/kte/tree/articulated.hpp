#pragma once

#include <kte/tree/give_way.hpp>

/// The articulated-body algorithm (ABA; Featherstone 1983; 2008, section 7.3) on classical accelerations A = (a, al).
/// A body must be pushed by I A - W, with I its articulated inertia and W its load.
namespace kte::tree {

/// The articulated inertia of a body that carries nothing.
template <class S, class P>
KTE_INLINE articulated_inertia<S> own_inertia(const record<P>& r) {
  const S mass(r.weight.mass);
  const vec3<S> h = as<S>(r.weight.moment);
  return {{mass, S(0), S(0), mass, S(0), mass},
          {{S(0), h.z, -h.y}, {-h.z, S(0), h.x}, {h.y, -h.x, S(0)}},
          as<S>(r.weight.inertia)};
}
/// What velocities alone make of a body: of one that moves by w, its load.
template <class P, class S>
KTE_INLINE dense_wrench<S> load_of_velocity(const record<P>& r, const vec3<S>& w) {
  const rigid_body<P, vec3<P>, sym3<P>>& b = r.body;
  const vec3<S> force = b.mass * cross(w, cross(w, b.com));
  return {-force, -(cross(w, b.inertia * w) + cross(b.com, force))};
}
/// The drift of a body, and its angular velocity from that of its parent, where the joint is not one about z.
template <class P, class S>
KTE_INLINE void drift_by_axes(const record<P>& r, const S* rate, vec3<S>& drift, vec3<S>& ang_drift, vec3<S>& w) {
  vec3<S> v_j{}, w_j{};
  along_axes(r, rate, v_j, w_j);
  drift = drift + (S(2) * cross(w, v_j) + cross(w_j, v_j));
  ang_drift = cross(w, w_j);
  w = w + w_j;
}
/// The same of one of several axes, apart as `move_by_several`.
template <class P, class S>
[[gnu::noinline]] void drift_by_several(const record<P>& r, const spot<S>& at, const S* rate, articulated_body<S>& x,
                                        vec3<S>& w) {
  const placed seat{r, at};
  x.drift = seat.in_of_several(cross(w, cross(w, at.position)));
  w = seat.in_of_several(w);
  drift_by_axes(r, rate, x.drift, x.ang_drift, w);
  x.load = load_of_velocity(r, w);
}
/// W of every body alone, and I of those on which several stand; what velocities alone add to accelerations, at bodies
/// of which `yields` is false also what is given. Needs the motions of bases; without `moving` there are no velocities
/// and nothing is given.
template <class P, class S>
void start_articulated(const forest<P>& f, memory<P, S>& m, bool moving) {
  const int bases = f.bases;
  vec3<S> w{};  // of the body before, in registers
  int at_hand = -1;
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const auto slot = static_cast<std::size_t>(bases) + i;
    articulated_body<S>& x = m.articulated[slot];
    if (r.branches) x.inertia = own_inertia<S>(r);
    if (!moving) {
      x.load = {};
      x.drift = x.ang_drift = {};
      continue;
    }
    const placed at{r, m.spots[i]};
    if (r.parent != at_hand) w = m.bodies[static_cast<std::size_t>(r.parent)].ang_velocity;
    at_hand = static_cast<int>(slot);
    const S* const rate = &m.rate[static_cast<std::size_t>(r.first)];
    if (r.moves == joint::several) [[unlikely]] {
      body_motion<S>& motion = m.bodies[slot];
      motion.ang_velocity = w;
      drift_by_several(r, m.spots[i], rate, x, motion.ang_velocity);
      w = motion.ang_velocity;
    } else {
      vec3<S> drift = at.in(cross(w, cross(w, m.spots[i].position))), ang_drift{};
      w = at.in(w);
      if (r.moves == joint::revolute) {
        ang_drift.x = w.y * *rate, ang_drift.y = -w.x * *rate;
        w.z += *rate;
      } else {
        drift_by_axes(r, rate, drift, ang_drift, w);
      }
      x.drift = drift, x.ang_drift = ang_drift;
      m.bodies[slot].ang_velocity = w;
      x.load = load_of_velocity(r, w);
    }
    if (!m.yields[i]) [[unlikely]]
      along_axes(r, &m.acceleration[static_cast<std::size_t>(r.first)], x.drift, x.ang_drift);
  }
}

/// Articulated inertias of all bodies, from the last. Returns the first axis of a joint that has nothing to move, or
/// -1.
template <class P, class S>
int articulate(const forest<P>& f, memory<P, S>& m) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  int bad = -1;
  // What the body at hand carries stays in registers: of the last child in this order, which stands next to it.
  burden<S> hand;
  bool at_hand = false;
  const auto add = [](burden<S>& to, const articulated_inertia<S>& i, const dense_wrench<S>& w) KTE_INLINE_LAMBDA {
    to.inertia.linear = to.inertia.linear + i.linear, to.inertia.coupling = to.inertia.coupling + i.coupling;
    to.inertia.angular = to.inertia.angular + i.angular;
    to.load = {to.load.force + w.force, to.load.torque + w.torque};
  };
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const auto k = static_cast<std::size_t>(r.first);
    const articulated_body<S>& x = m.articulated[bases + i];
    if (!at_hand) hand = {own_inertia<S>(r), x.load};  // no body stands on it
    const bool on_base = r.parent < f.bases;
    int own = -1;
    if (r.moves == joint::revolute && m.yields[i] && m.own_mass[k] == P(0)) {
      if (!give_way_about_z(r, m.spots[i], m.force[k], x.drift, x.ang_drift, hand, m.answers[k], on_base)) [[unlikely]]
        own = 0;
    } else {
      burden<S> in_memory = hand;
      own = give_way(r, m.spots[i], m.yields[i] != 0, &m.force[k], &m.own_mass[k], x.drift, x.ang_drift, in_memory,
                     &m.answers[k], on_base);
      hand = in_memory;
    }
    if (own >= 0 && bad < 0) [[unlikely]]
      bad = r.first + own;
    at_hand = !on_base && static_cast<std::size_t>(r.parent) + 1 == bases + i;
    if (on_base) continue;
    articulated_body<S>& to = m.articulated[static_cast<std::size_t>(r.parent)];
    if (!at_hand) {
      burden<S> sum{to.inertia, to.load};
      add(sum, hand.inertia, hand.load);
      to.inertia = sum.inertia, to.load = sum.load;
    } else if (f.records[i - 1].branches) {
      add(hand, to.inertia, to.load);
    } else {
      add(hand, own_inertia<S>(f.records[i - 1]), to.load);
    }
  }
  return bad;
}

/// (2) of `accelerate` for any joint.
template <class P, class S>
KTE_INLINE void accelerate_axes(const record<P>& r, const axis_answer<S>* answers, const P* own_mass, S* change,
                                vec3<S>& a, vec3<S>& al) {
  for (int k = 0; k < r.axes; ++k) {
    const auto& [gain, rate, inverse] = answers[k];
    if (r.moves == joint::screw || own_mass[k] != P(0)) {
      change[k] = rate - (dot(gain.force, a) + dot(gain.torque, al));
      std::array<S, 6> one{};
      one[static_cast<std::size_t>(k)] = change[k];
      along_axes(r, one.data(), a, al);
    } else {
      S& along = component(a, al, r.axis[static_cast<std::size_t>(k)]);
      const S before = along;
      along = S(0);
      along = rate - (dot(gain.force, a) + dot(gain.torque, al));
      change[k] = along - before;
    }
  }
}

/// The same of a body that does not turn about z alone, from the acceleration (a, al) of its parent. Apart as
/// `move_by_several`.
template <class P, class S>
[[gnu::noinline]] void accelerate_by_axes(const record<P>& r, const spot<S>& at, const articulated_body<S>& x,
                                          bool yields, const axis_answer<S>* answers, const P* own_mass, S* change,
                                          vec3<S>& a, vec3<S>& al) {
  const placed seat{r, at};
  const bool several = r.moves == joint::several;
  const vec3<S> moved = a + cross(al, at.position);
  a = (several ? seat.in_of_several(moved) : seat.in(moved)) + x.drift;
  al = (several ? seat.in_of_several(al) : seat.in(al)) + x.ang_drift;
  if (yields) accelerate_axes(r, answers, own_mass, change, a, al);
}

/// The way out: accelerations of all bodies and axes from the motions of the bases,
///
///   A' = A of the parent seen from the body + drift,   q_ddot = rate - gain . A',   A = A' + s q_ddot     (2)
///
/// Along a unit axis without a mass of its own A is rate - gain . (rest of A'), whatever A' is.
template <class P, class S>
void accelerate(const forest<P>& f, memory<P, S>& m) {
  vec3<S> a{}, al{};  // of the body before, in registers
  int at_hand = -1;
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const placed at{r, m.spots[i]};
    if (r.parent != at_hand) {
      const body_motion<S>& base = m.bodies[static_cast<std::size_t>(r.parent)];
      a = base.acceleration, al = base.ang_acceleration;
    }
    at_hand = f.bases + static_cast<int>(i);
    const articulated_body<S>& x = m.articulated[static_cast<std::size_t>(at_hand)];
    S* const change = &m.acceleration[static_cast<std::size_t>(r.first)];
    const axis_answer<S>* const answers = &m.answers[static_cast<std::size_t>(r.first)];
    const P* const own_mass = &m.own_mass[static_cast<std::size_t>(r.first)];
    if (r.moves == joint::revolute && *own_mass == P(0)) [[likely]] {
      a = at.in(a + cross(al, m.spots[i].position)) + x.drift;
      al = at.in(al) + x.ang_drift;
      if (m.yields[i]) {
        const auto& [gain, rate, inverse] = *answers;
        const S now = rate - (dot(gain.force, a) + (gain.torque.x * al.x + gain.torque.y * al.y));
        *change = now - al.z, al.z = now;
      }
    } else {
      vec3<S> in_memory = a, ang_in_memory = al;
      accelerate_by_axes(r, m.spots[i], x, m.yields[i] != 0, answers, own_mass, change, in_memory, ang_in_memory);
      a = in_memory, al = ang_in_memory;
    }
    body_motion<S>& motion = m.bodies[static_cast<std::size_t>(at_hand)];
    motion.acceleration = a, motion.ang_acceleration = al;
  }
}

}  // namespace kte::tree
