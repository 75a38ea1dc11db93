#pragma once

#include <kte/tree/composite.hpp>
#include <kte/tree/newton_euler.hpp>

/// Derivatives of inverse dynamics (Singh, Russo and Wensing, Efficient analytical derivatives of rigid-body dynamics
/// using spatial vector algebra, 2022), in world axes at the origin of each body. Spatial vectors: a motion is
/// (linear, angular), the velocity of the point of the body at the origin and its rotation. Each body is seen by an
/// observer who moves on with its origin at the speed that it has now, so that no large speed is ever subtracted from
/// another.
namespace kte::tree {

template <class S>
struct spatial_motion {
  vec3<S> linear{}, angular{};
  KTE_INLINE friend spatial_motion operator+(const spatial_motion& a, const spatial_motion& b) {
    return {a.linear + b.linear, a.angular + b.angular};
  }
};
/// The change of a motion b that moves with a.
template <class S>
KTE_INLINE spatial_motion<S> cross(const spatial_motion<S>& a, const spatial_motion<S>& b) {
  return {cross(a.angular, b.linear) + cross(a.linear, b.angular), cross(a.angular, b.angular)};
}
template <class S>
KTE_INLINE S power(const spatial_motion<S>& m, const dense_wrench<S>& w) {
  return dot(m.linear, w.force) + dot(m.angular, w.torque);
}

/// Of an axis s in a body that moves by v, whose parent moves by v_p, a_p (all at the origin of the body):
///
///   s' = v_p x s,   s'' = a_p x s + v_p x s',   mixed = s' + v x s          (1)
template <class S>
struct axis_variation {
  spatial_motion<S> axis, second, mixed;
  vec3<S> first;  ///< the angular part of s'
};
/// Of a body with all it carries: inertia M, and 2 B, which acts on angular parts alone,
///
///   B = (v x* M - M v x + (M v) x*) / 2          (2)
///
/// `passing`: the speed of its origin to the observer of its parent.
template <class S>
struct body_variation {
  vec3<S> ang_velocity, acceleration, ang_acceleration, passing;
  dense_composite<S> inertia;
  vec3<S> force;         ///< 2 B gives the force `force` x w
  mat3<vec3<S>> torque;  ///< and the torque `torque` w
};
/// [a]x [b]x
template <class S>
KTE_INLINE mat3<vec3<S>> cross_twice(const vec3<S>& a, const vec3<S>& b) {
  const S d = dot(a, b);
  mat3<vec3<S>> m{b.x * a, b.y * a, b.z * a};
  m.x.x -= d, m.y.y -= d, m.z.z -= d;
  return m;
}
template <class S>
struct variation_memory {
  std::vector<axis_variation<S>> axes;
  std::vector<body_variation<S>> bodies;  ///< of slots
};

/// (1), (2) of each body alone. After `move_bodies`, `place_in_world`.
template <class P, class S>
void start_variations(const forest<P>& f, const memory<P, S>& m, variation_memory<S>& v) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  const auto take_motion = [&](std::size_t slot) {
    const mat3<vec3<S>>& r = m.world[slot].rotation;
    const body_motion<S>& b = m.bodies[slot];
    body_variation<S>& x = v.bodies[slot];
    x.ang_velocity = r * b.ang_velocity, x.acceleration = r * b.acceleration;
    x.ang_acceleration = r * b.ang_acceleration;
  };
  for (std::size_t b = 0; b < bases; ++b) take_motion(b);
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const std::size_t slot = bases + i;
    const world_place<S>& place = m.world[slot];
    take_motion(slot);
    body_variation<S>& b = v.bodies[slot];
    const body_variation<S>& parent = v.bodies[static_cast<std::size_t>(r.parent)];
    const vec3<S>& w_p = parent.ang_velocity;
    vec3<S> slides{};  // of the joint
    if (r.moves != joint::revolute)
      for (int k = r.first; k < r.first + r.axes; ++k)
        slides = slides + m.rate[static_cast<std::size_t>(k)] * m.axes[static_cast<std::size_t>(k)].linear;
    const vec3<S> turned = cross(w_p, place.step);
    b.passing = turned + slides;
    const spatial_motion<S> v_p{-slides, w_p};
    const spatial_motion<S> a_p{
        parent.acceleration + (cross(parent.ang_acceleration, place.step) + cross(w_p, vec3<S>(turned + slides))),
        parent.ang_acceleration};
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const world_axis<S>& s = m.axes[static_cast<std::size_t>(k)];
      axis_variation<S>& x = v.axes[static_cast<std::size_t>(k)];
      x.axis = {s.linear, s.angular};
      if (r.moves == joint::revolute) {  // what is linear is nothing; w x s is s'
        x.first = cross(w_p, s.angular);
        x.second = {cross(a_p.linear, s.angular), cross(a_p.angular, s.angular) + cross(w_p, x.first)};
        x.mixed = {{}, S(2) * x.first};
        continue;
      }
      const spatial_motion<S> first = cross(v_p, x.axis);
      x.first = first.angular;
      x.second = cross(a_p, x.axis) + cross(v_p, first);
      x.mixed = first + cross(spatial_motion<S>{{}, b.ang_velocity}, x.axis);  // (1)
    }
    const rigid_body<P, vec3<P>, sym3<P>>& body = r.body;
    const vec3<S> c = place.rotation * body.com;
    const vec3<S>& w = b.ang_velocity;
    const sym3<S> inertia = congruence(place.rotation, body.inertia);
    b.inertia = {S(body.mass), body.mass * c, detail::shifted(inertia, c, detail::half(S(body.mass)) * c)};
    b.force = S(-2) * (body.mass * cross(w, c));
    // w x J - J w x - [J w] x; transposed, w x J is -J w x
    const mat3<vec3<S>> wj = as<S>(cross_matrix(w) * full(inertia));
    b.torque = as<S>((wj + transpose(wj)) + (cross_twice(c, b.force) - cross_matrix(vec3<S>(inertia * w))));
  }
}

/// The derivatives of the forces on axes, with F what a body and all beyond it need (`take_needs`):
///
///   d tau_j / d q_i = s_j . (2B s_i' + M s_i'' + s_i x* F)     for axes j of bodies that body i stands on     (3)
///   d tau_i / d q_j = s_i . (2B s_j' + M s_j'')                and for axes of one body                      (4)
///   d tau_j / d v_i = s_j . (2B s_i + M mixed_i),   d tau_i / d v_j likewise,   d tau_j / d a_i = s_j . M s_i   (5)
///
/// B and M of body i and all beyond it. To an observer by whom all pass at u more, 2B is
///
///   force -2 m [u]x,   torque -2 [h]x [u]x          (6)
///
/// more. put(j, i, by_q, by_v, by_a): change of tau_j by coordinate i.
template <class P, class S, class Put>
void vary_forces(const forest<P>& f, const memory<P, S>& m, variation_memory<S>& v, const Put& put) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const world_place<S>& place = m.world[bases + i];
    const body_variation<S>& b = v.bodies[bases + i];
    const dense_wrench<S> needs{place.rotation * m.bodies[bases + i].needs.force,
                                place.rotation * m.bodies[bases + i].needs.torque};
    const S& mass = b.inertia.mass;
    const vec3<S>& h = b.inertia.moment;
    const sym3<S>& inertia = b.inertia.inertia;
    const bool turns = r.moves == joint::revolute;
    const auto accelerated = [&](const spatial_motion<S>& a) KTE_INLINE_LAMBDA {
      return dense_wrench<S>{mass * a.linear + cross(a.angular, h), inertia * a.angular + cross(h, a.linear)};
    };
    const auto turning = [&](const vec3<S>& al) KTE_INLINE_LAMBDA {
      return dense_wrench<S>{cross(al, h), inertia * al};
    };
    const auto pushed = [&](const vec3<S>& w, const dense_wrench<S>& x) KTE_INLINE_LAMBDA {
      return dense_wrench<S>{x.force + cross(b.force, w), x.torque + b.torque * w};
    };
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const axis_variation<S>& x = v.axes[static_cast<std::size_t>(k)];
      const auto& s = x.axis;
      dense_wrench<S> by_q = pushed(x.first, accelerated(x.second));
      dense_wrench<S> by_v = pushed(s.angular, turns ? turning(x.mixed.angular) : accelerated(x.mixed));
      dense_wrench<S> by_a = turns ? turning(s.angular) : accelerated(s);
      for (int j = r.first; j < r.first + r.axes; ++j) {
        const auto& own = v.axes[static_cast<std::size_t>(j)].axis;
        put(j, k, power(own, by_q), power(own, by_v), power(own, by_a));
      }
      if (r.parent < f.bases) continue;
      by_q = {by_q.force + cross(s.angular, needs.force), by_q.torque + cross(s.angular, needs.torque)};
      vec3<S> to_rate = transpose(b.torque) * s.angular;
      if (!turns) {
        by_q.torque = by_q.torque + cross(s.linear, needs.force);
        to_rate = to_rate - cross(b.force, s.linear);
      }
      for (std::size_t slot = bases + i;;) {
        const vec3<S>& step = m.world[slot].step;
        by_q.torque = by_q.torque + cross(step, by_q.force);
        by_v.torque = by_v.torque + cross(step, by_v.force);
        by_a.torque = by_a.torque + cross(step, by_a.force);
        to_rate = to_rate + S(2) * cross(v.bodies[slot].passing, by_a.force);  // what (6) makes of it
        slot = static_cast<std::size_t>(f.records[slot - bases].parent);
        const record<P>& before = f.records[slot - bases];
        for (int j = before.first; j < before.first + before.axes; ++j) {
          const axis_variation<S>& y = v.axes[static_cast<std::size_t>(j)];
          const vec3<S>& z = y.axis.angular;
          S at_q = dot(z, by_q.torque), at_v = dot(z, by_v.torque), at_a = dot(z, by_a.torque);
          S from_v = dot(to_rate, z) + dot(y.mixed.angular, by_a.torque);
          if (before.moves != joint::revolute) {
            at_q += dot(y.axis.linear, by_q.force), at_v += dot(y.axis.linear, by_v.force);
            at_a += dot(y.axis.linear, by_a.force), from_v += dot(y.mixed.linear, by_a.force);
          }
          put(j, k, at_q, at_v, at_a);
          put(k, j, dot(to_rate, y.first) + power(y.second, by_a), from_v, at_a);
        }
        if (before.parent < f.bases) break;
      }
    }
    if (r.parent < f.bases) continue;
    body_variation<S>& to = v.bodies[static_cast<std::size_t>(r.parent)];
    const vec3<S>&p = place.step, force = b.force - (S(2) * mass) * b.passing;
    const sym3<S> seen = detail::shifted(inertia, p, h + detail::half(mass) * p);
    to.inertia = {to.inertia.mass + mass, to.inertia.moment + (h + mass * p), to.inertia.inertia + seen};
    to.force = to.force + force;
    to.torque = to.torque + (b.torque + (cross_twice(h, vec3<S>(S(-2) * b.passing)) + cross_twice(p, force)));  // (6)
  }
}

}  // namespace kte::tree
