#pragma once

#include <kte/tree/variations.hpp>

namespace kte::tree {

/// The derivatives of the forces on axes. F is the wrench of a body and its subtree (`transmit_wrenches`); notation of
/// (1), (2) of tree/variations.hpp:
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
template <class P, class S, class Put>
void vary_forces(const body_tree<P>& f, const memory<P, S>& m, variation_memory<S>& v, const Put& put) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  using four = simd<S, 4>;
  using vectors = vec3<four>;
  for (std::size_t i = f.nodes.size(); i-- > 0;) {
    const body_node<P>& r = f.nodes[i];
    const world_place<S>& place = m.world[bases + i];
    const body_variation<S>& b = v.bodies[bases + i];
    const dense_wrench<S> body_wrench{place.rotation * m.wrenches[bases + i].force,
                                      place.rotation * m.wrenches[bases + i].torque};
    const S& mass = b.inertia.mass;
    const vec3<S>& h = b.inertia.moment;
    const sym3<S>& inertia = b.inertia.inertia;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const axis_variation<S>& x = v.axes[static_cast<std::size_t>(k)];
      vectors linear, angular, turning;
      load_vectors<S>(linear, x.linear), load_vectors<S>(angular, x.angular), load_vectors<S>(turning, x.turning);
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
      const auto power_on = [&](const spatial_motion<S>& s, bool slides, four& power) KTE_INLINE_LAMBDA {
        power = s.angular.x * torque.x + s.angular.y * torque.y + s.angular.z * torque.z;
        if (slides) power += s.linear.x * pushing.x + s.linear.y * pushing.y + s.linear.z * pushing.z;
      };
      const bool slides = r.moves != joint::revolute;
      for (int j = r.first; j < r.first + r.axes; ++j) {
        four own;
        power_on(v.axes[static_cast<std::size_t>(j)].axis(), slides, own);
        put(j, k, S(own[0]), S(own[1]), S(own[2]));
      }
      if (r.parent < f.bases) continue;
      const spatial_motion<S> s = x.axis();
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
      for (std::size_t slot = bases + i;;) {
        vectors ways;
        load_vectors<S>(ways, v.bodies[slot].ways);
        add_cross(torque, ways, force);
        vectors from_rates;  // F_a thrice, 2B^T s
        repeat_third<S>(torque.x, from_rates.x), repeat_third<S>(torque.y, from_rates.y);
        repeat_third<S>(torque.z, from_rates.z);
        slot = static_cast<std::size_t>(f.nodes[slot - bases].parent);
        const body_node<P>& before = f.nodes[slot - bases];
        const bool before_slides = before.moves != joint::revolute;
        for (int j = before.first; j < before.first + before.axes; ++j) {
          const axis_variation<S>& y = v.axes[static_cast<std::size_t>(j)];
          load_vectors<S>(linear, y.linear), load_vectors<S>(angular, y.angular);
          four on, back;
          power_on(y.axis(), before_slides, on);
          back = angular.x * from_rates.x + angular.y * from_rates.y + angular.z * from_rates.z;
          back += by_a.x * linear.x + by_a.y * linear.y + by_a.z * linear.z;
          const S at_a = S(on[2]);
          put(j, k, S(on[0]), S(on[1]), at_a);                        // (3), (5)
          put(k, j, S(back[0] + back[3]), S(back[1] + on[3]), at_a);  // (4), (5)
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
