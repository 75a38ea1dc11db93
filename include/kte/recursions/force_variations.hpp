#pragma once

#include <kte/recursions/coriolis.hpp>
#include <kte/recursions/gyration.hpp>

/// The derivatives of inverse dynamics by q, v and a, as first variations. For each axis j, the changes of the wrench
/// on its body go inward, and give the derivatives for all axes on the way to the base. There are two forms:
///
///   in axes of the bodies     for static chains, whose typed zeros fold
///   in axes of the world      for loops over arrays, with four vectors side by side
///
/// The first in a loop takes 1.8 to 2.7 times as long as the second (docs/decisions/24-engine.md).

// ---- in axes of the bodies: (1) of recursions/gyration.hpp, one element at a time
namespace kte::detail {

/// A change of motion of a frame.
template <class W, class A, class AL>
struct variation {
  W ang_velocity;
  A acceleration;
  AL ang_acceleration;
};
template <class W, class A, class AL>
variation(W, A, AL) -> variation<W, A, AL>;

/// (1) of recursions/gyration.hpp
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
/// Inward: the derivatives of the forces on all axes.
template <class Driver, class Put>
KTE_INLINE constexpr void derivatives_of_forces(const Driver& d, const Put& put) {
  d.template inward<false, engine::no_value, false>(engine::no_value{}, engine::kept_constant<engine::no_value>{},
                                                    turning_alone{}, variation_columns<Put>{put}, turning_to_parent{});
}

}  // namespace kte::detail

// ---- in axes of the world
namespace kte::engine {

/// The derivatives of the forces on axes (Singh, Russo and Wensing, Efficient analytical derivatives of rigid-body
/// dynamics using spatial vector algebra, 2022). F is the wrench of a body and its subtree; notation of (1), (2) of
/// tree/variations.hpp:
///
///   d tau_j / d q_i = s_j . (2B s_i' + M s_i'' + s_i x* F)     for axes j of ancestors of body i              (3)
///   d tau_i / d q_j = s_i . (2B s_j' + M s_j'')                and for axes of one body                      (4)
///   d tau_j / d v_i = s_j . (2B s_i + M mixed_i),   d tau_i / d v_j likewise,   d tau_j / d a_i = s_j . M s_i   (5)
///
/// B and M are those of body i with its subtree. For an observer relative to whom all bodies move faster by u, 2B
/// increases by
///
///   force -2 m [u]x,   torque -2 [h]x [u]x          (6)
///
/// The wrenches F_q, F_v, F_a that (3) to (5) multiply by s_j go inward side by side: T += p x F. With them goes 2B^T
/// s_i, which (4), (5) multiply by s_j' and s_j; it increases by 2 u x F_a. put(j, i, by_q, by_v, by_a): derivatives of
/// tau_j by coordinate i.
///
/// t.slides(i): whether an axis of joint i has a linear part. `axes`, `bodies`: of tree/variations.hpp; `bodies`
/// change. wrench_of(i): F. `Lanes`: four numbers side by side (tree/variations.hpp).
template <class Lanes, class S, world_joints T, class Axis, class Body, class WrenchOf, class Put>
void vary_forces_in_world(const T& t, const Axis* axes, Body* bodies, const WrenchOf& wrench_of, const Put& put) {
  using four = typename Lanes::type;
  using vectors = vec3<four>;
  for (int i = t.count(); i-- > 0;) {
    const Body& b = bodies[i];
    const wrench<vec3<S>, vec3<S>> body_wrench = wrench_of(i);
    const int first = t.first(i), end = first + t.axes(i);
    const S& mass = b.inertia.mass;
    const vec3<S>& h = b.inertia.moment;
    const sym3<S>& inertia = b.inertia.inertia;
    for (int k = first; k < end; ++k) {
      const Axis& x = axes[k];
      vectors linear, angular, turning;
      Lanes::load(linear, x.linear), Lanes::load(angular, x.angular), Lanes::load(turning, x.turning);
      vectors force{mass * linear.x, mass * linear.y, mass * linear.z};
      add_cross(force, angular, h), add_cross(force, b.force, turning);
      vectors torque{inertia.xx * angular.x + inertia.xy * angular.y + inertia.xz * angular.z,
                     inertia.xy * angular.x + inertia.yy * angular.y + inertia.yz * angular.z,
                     inertia.xz * angular.x + inertia.yz * angular.y + inertia.zz * angular.z};
      add_cross(torque, h, linear);
      torque.x += b.torque.x.x * turning.x + b.torque.x.y * turning.y + b.torque.x.z * turning.z;
      torque.y += b.torque.y.x * turning.x + b.torque.y.y * turning.y + b.torque.y.z * turning.z;
      torque.z += b.torque.z.x * turning.x + b.torque.z.y * turning.y + b.torque.z.z * turning.z;
      vectors pushing = force;  // zero except F_a
      const auto power_on = [&](const auto& s, bool slides, four& power) KTE_INLINE_LAMBDA {
        power = s.angular.x * torque.x + s.angular.y * torque.y + s.angular.z * torque.z;
        if (slides) power += s.linear.x * pushing.x + s.linear.y * pushing.y + s.linear.z * pushing.z;
      };
      const bool slides = t.slides(i);
      for (int j = first; j < end; ++j) {
        four own;
        power_on(axes[j].axis(), slides, own);
        put(j, k, S(own[0]), S(own[1]), S(own[2]));
      }
      if (t.parent(i) < 0) continue;
      const auto s = x.axis();
      const vec3<S> more = cross(s.angular, body_wrench.force);
      vec3<S> more_torque = cross(s.angular, body_wrench.torque), to_rate = transpose(b.torque) * s.angular;
      if (slides) {
        more_torque = more_torque + cross(s.linear, body_wrench.force);
        to_rate = to_rate - cross(b.force, s.linear);
      }
      force.x[0] += more.x, force.y[0] += more.y, force.z[0] += more.z;
      pushing = force;
      pushing.x[3] = pushing.y[3] = pushing.z[3] = S(0);
      force.x[3] = force.x[2], force.y[3] = force.y[2], force.z[3] = force.z[2];
      torque.x[0] += more_torque.x, torque.y[0] += more_torque.y, torque.z[0] += more_torque.z;
      torque.x[3] = to_rate.x, torque.y[3] = to_rate.y, torque.z[3] = to_rate.z;
      const vec3<S> by_a{force.x[2], force.y[2], force.z[2]};
      for (int at = i, inward = t.parent(i); inward >= 0;) {
        vectors ways;
        Lanes::load(ways, bodies[at].ways);
        add_cross(torque, ways, force);
        vectors from_rates;  // F_a thrice, 2B^T s
        Lanes::repeat_third(torque.x, from_rates.x), Lanes::repeat_third(torque.y, from_rates.y);
        Lanes::repeat_third(torque.z, from_rates.z);
        at = inward, inward = t.parent(at);
        const bool before_slides = t.slides(at);
        const int before = t.first(at), before_end = before + t.axes(at);
        for (int j = before; j < before_end; ++j) {
          const Axis& y = axes[j];
          Lanes::load(linear, y.linear), Lanes::load(angular, y.angular);
          four on, back;
          power_on(y.axis(), before_slides, on);
          back = angular.x * from_rates.x + angular.y * from_rates.y + angular.z * from_rates.z;
          back += by_a.x * linear.x + by_a.y * linear.y + by_a.z * linear.z;
          const S at_a = S(on[2]);
          put(j, k, S(on[0]), S(on[1]), at_a);                        // (3), (5)
          put(k, j, S(back[0] + back[3]), S(back[1] + on[3]), at_a);  // (4), (5)
        }
      }
    }
    if (t.parent(i) < 0) continue;
    Body& to = bodies[t.parent(i)];
    const vec3<S>&p = t.step(i), force = b.force - (S(2) * mass) * b.passing;
    const sym3<S> seen = kte::detail::shifted(inertia, p, h + kte::detail::half(mass) * p);
    to.inertia = {to.inertia.mass + mass, to.inertia.moment + (h + mass * p), to.inertia.inertia + seen};
    to.force = to.force + force;
    to.torque = to.torque + (b.torque + (cross_twice(h, vec3<S>(S(-2) * b.passing)) + cross_twice(p, force)));  // (6)
  }
}

}  // namespace kte::engine
