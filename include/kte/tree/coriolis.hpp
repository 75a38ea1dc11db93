#pragma once

#include <kte/tree/composite.hpp>

#include <vector>

namespace kte::tree {

/// A body with all that it carries, about its origin in axes of the world: mass, moment h, inertia I; and B of
/// `coriolis_terms` by P and N.
template <class S>
struct coriolis_body {
  dense_composite<S> carried;
  vec3<S> momentum;       ///< P
  mat3<vec3<S>> turning;  ///< N
  vec3<S> velocity, ang_velocity;
};
template <class S>
struct coriolis_memory {
  std::vector<coriolis_body<S>> bodies;  ///< of slots
  std::vector<world_axis<S>> changes;    ///< of axes: how they change
};

/// The velocities of all bodies and the changes of axes, which are constant in their bodies:
///
///   ds/dt = v x s,   of linear part w x s_v + v x s_w and angular part w x s_w          (1)
///
/// and of each body alone, with P its momentum m v + w x h,
///
///   B s = (s_w x P,  N s_w),   N = ([w]x I - [I w]x - I [w]x) / 2 - [h]x [v]x          (2)
///
/// After `place_in_world`, with the velocities of bases in `bodies`, in axes of the world.
template <class P, class S>
void start_coriolis(const forest<P>& f, const memory<P, S>& m, coriolis_memory<S>& x) {
  x.changes.resize(f.axes());
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i;
    const coriolis_body<S>& on = x.bodies[static_cast<std::size_t>(r.parent)];
    const world_place<S>& place = m.world[slot];
    vec3<S> v = on.velocity + cross(on.ang_velocity, place.step), w = on.ang_velocity;
    for (auto k = static_cast<std::size_t>(r.first); k < static_cast<std::size_t>(r.first + r.axes); ++k)
      v = v + m.rate[k] * m.axes[k].linear, w = w + m.rate[k] * m.axes[k].angular;
    for (auto k = static_cast<std::size_t>(r.first); k < static_cast<std::size_t>(r.first + r.axes); ++k) {
      const world_axis<S>& s = m.axes[k];
      x.changes[k] = {cross(w, s.linear) + cross(v, s.angular), cross(w, s.angular)};  // (1)
    }
    const S mass = S(r.weight.mass);
    const vec3<S> h = place.rotation * as<S>(r.weight.moment);
    const sym3<S> inertia = as<S>(congruence(place.rotation, as<S>(r.weight.inertia)));
    const mat3<vec3<S>> dense = as<S>(full(inertia)), spin = as<S>(cross_matrix(w));
    const mat3<vec3<S>> twice = spin * dense - as<S>(cross_matrix(vec3<S>(inertia * w))) - dense * spin;
    x.bodies[slot] = {{mass, h, inertia},
                      mass * v + cross(w, h),
                      S(1) / S(2) * twice - as<S>(cross_matrix(h)) * as<S>(cross_matrix(v)),
                      v,
                      w};  // (2)
  }
}

/// The matrix C(q, v) of Coriolis and centrifugal forces that is made of Christoffel's symbols: dM/dt - 2 C is
/// skew-symmetric, and C v are the forces (Echeandia, Wensing, J. Computational Nonlinear Dynamics 16(9), 2021,
/// algorithm 1). With I^c and B^c of all that is beyond axis k,
///
///   C_jk = s_j . (I^c ds_k/dt + B^c s_k),   C_kj = ds_j/dt . (I^c s_k) + s_j . (B^c^T s_k)          (3)
///   M_jk = s_j . (I^c s_k)                                                                          (4)
///
/// for k and all axes j before it: put(j, k, C_jk, M_jk), once for each ordered pair that moves a body together.
/// Wrenches and B go in to the origin of the parent, by d from there,
///
///   n + d x f,   N - [d]x [P]x          (5)
///
/// so that nothing is lost where a chain stands far from the origin of the world. After `start_coriolis`.
template <class P, class S, class Put>
void coriolis_terms(const forest<P>& f, const memory<P, S>& m, coriolis_memory<S>& x, const Put& put) {
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const coriolis_body<S>& b = x.bodies[static_cast<std::size_t>(f.bases) + i];
    const auto& [mass, h, inertia] = b.carried;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      const world_axis<S>&s = m.axes[static_cast<std::size_t>(k)], &change = x.changes[static_cast<std::size_t>(k)];
      dense_wrench<S> first{mass * change.linear + cross(change.angular, h) + cross(s.angular, b.momentum),
                            inertia * change.angular + cross(h, change.linear) + b.turning * s.angular};
      dense_wrench<S> second{mass * s.linear + cross(s.angular, h), inertia * s.angular + cross(h, s.linear)};
      const vec3<S> third = transpose(b.turning) * s.angular + cross(b.momentum, s.linear);
      const auto power = [](const world_axis<S>& on, const dense_wrench<S>& w) {
        return S(dot(on.linear, w.force) + dot(on.angular, w.torque));
      };
      for (int j = r.first; j < r.first + r.axes; ++j) {
        const world_axis<S>& on = m.axes[static_cast<std::size_t>(j)];
        put(j, k, power(on, first), power(on, second));  // (3), (4)
      }
      for (std::size_t at = i; f.records[at].parent >= f.bases;) {
        const vec3<S>& step = m.world[static_cast<std::size_t>(f.bases) + at].step;
        first.torque = first.torque + cross(step, first.force),
        second.torque = second.torque + cross(step, second.force);
        at = static_cast<std::size_t>(f.records[at].parent - f.bases);
        const record<P>& before = f.records[at];
        for (int j = before.first; j < before.first + before.axes; ++j) {
          const world_axis<S>& on = m.axes[static_cast<std::size_t>(j)];
          const S mass_jk = power(on, second);
          put(j, k, power(on, first), mass_jk);
          put(k, j, S(power(x.changes[static_cast<std::size_t>(j)], second) + dot(on.angular, third)), mass_jk);
        }
      }
    }
    if (r.parent < f.bases) continue;
    const vec3<S>& d = m.world[static_cast<std::size_t>(f.bases) + i].step;
    coriolis_body<S>& to = x.bodies[static_cast<std::size_t>(r.parent)];
    to.carried = {to.carried.mass + mass, to.carried.moment + h + mass * d,
                  to.carried.inertia + as<S>(detail::shifted(inertia, d, h + detail::half(mass) * d))};
    to.momentum = to.momentum + b.momentum;
    to.turning = to.turning + b.turning - as<S>(cross_matrix(d)) * as<S>(cross_matrix(b.momentum));  // (5)
  }
}

}  // namespace kte::tree
