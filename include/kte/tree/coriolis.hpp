#pragma once

#include <kte/tree/composite.hpp>
#include <kte/tree/variations.hpp>

#include <vector>

/// The matrix C(q, v) of Coriolis and centrifugal forces by Christoffel symbols: dM/dt - 2 C is skew-symmetric, and C v
/// are the forces (Echeandia, Wensing, J. Computational Nonlinear Dynamics 16(9), 2021, algorithm 1). All quantities
/// are in the axes of the world at the origin of each body, so that accuracy does not depend on the distance from the
/// origin of the world.
namespace kte::tree {

/// A body with all bodies that it carries: mass, moment h, inertia I; and the matrix B of (2), given by P and N.
template <class S>
struct coriolis_body {
  dense_composite<S> carried{};
  vec3<S> momentum{};       ///< P
  mat3<vec3<S>> turning{};  ///< N
};

/// The rate of change of an axis s that is constant in a body of velocity v, w:
///
///   ds/dt:   linear part w x s_v + v x s_w,   angular part w x s_w          (1)
template <class S>
KTE_INLINE world_axis<S> change_of(const world_axis<S>& s, const vec3<S>& v, const vec3<S>& w) {
  return {cross(w, s.linear) + cross(v, s.angular), cross(w, s.angular)};
}
/// A body at this velocity, with the momentum P = m v + w x h:
///
///   B s = (s_w x P,  N s_w),   N = ([w]x I - I [w]x - [I w]x) / 2 - [h]x [v]x          (2)
template <class S>
KTE_INLINE coriolis_body<S> coriolis_of(const dense_composite<S>& own, const vec3<S>& v, const vec3<S>& w) {
  const auto& [mass, h, i] = own;
  return {own, mass * v + cross(w, h), gyroscopic(vec3<S>(S(1) / S(2) * w), i) - cross_twice(h, v)};
}

/// With I^c and B^c of all bodies beyond axis k, for k and all axes j before it,
///
///   C_jk = s_j . (I^c ds_k/dt + B^c s_k),   C_kj = ds_j/dt . (I^c s_k) + s_j . (B^c^T s_k)          (3)
///   M_jk = s_j . (I^c s_k)                                                                          (4)
///
/// by put(j, k, C_jk, M_jk), once for each ordered pair of axes that move a body together. Wrenches f, n and B pass
/// inward to the origin of the parent, at the distance d, as
///
///   n + d x f,   N - [d]x [P]x          (5)
///
/// `bodies`: the results of (2) for each body alone; they are changed. `t` gives for body i, parents first,
///   parent(i), first(i), axes(i), step(i)     the parent, or -1; its axes; d
template <class S, class Tree, class Put>
void coriolis_terms(const Tree& t, const world_axis<S>* axes, const world_axis<S>* changes, coriolis_body<S>* bodies,
                    const Put& put) {
  for (int i = t.count(); i-- > 0;) {
    const coriolis_body<S>& b = bodies[i];
    const auto& [mass, h, inertia] = b.carried;
    const int end = t.first(i) + t.axes(i);
    for (int k = t.first(i); k < end; ++k) {
      const world_axis<S>&s = axes[k], &change = changes[k];
      dense_wrench<S> first{mass * change.linear + cross(change.angular, h) + cross(s.angular, b.momentum),
                            inertia * change.angular + cross(h, change.linear) + b.turning * s.angular};
      dense_wrench<S> second{mass * s.linear + cross(s.angular, h), inertia * s.angular + cross(h, s.linear)};
      const vec3<S> third = transpose(b.turning) * s.angular + cross(b.momentum, s.linear);
      for (int j = t.first(i); j < end; ++j)
        put(j, k, power_on(axes[j], first), power_on(axes[j], second));  // (3), (4)
      for (int at = i; t.parent(at) >= 0;) {
        const vec3<S>& d = t.step(at);
        first.torque = first.torque + cross(d, first.force), second.torque = second.torque + cross(d, second.force);
        at = t.parent(at);
        for (int j = t.first(at); j < t.first(at) + t.axes(at); ++j) {
          const S mass_jk = power_on(axes[j], second);
          put(j, k, power_on(axes[j], first), mass_jk);
          put(k, j, S(power_on(changes[j], second) + dot(axes[j].angular, third)), mass_jk);
        }
      }
    }
    if (t.parent(i) < 0) continue;
    const vec3<S>& d = t.step(i);
    coriolis_body<S>& to = bodies[t.parent(i)];
    to.carried = {to.carried.mass + mass, to.carried.moment + h + mass * d,
                  to.carried.inertia + as<S>(detail::shifted(inertia, d, h + detail::half(mass) * d))};
    to.momentum = to.momentum + b.momentum;
    to.turning = to.turning + b.turning - cross_twice(d, b.momentum);  // (5)
  }
}

/// Body nodes in the form of such a tree.
template <class P, class S>
struct nodes_as_tree {
  const body_tree<P>& f;
  const memory<P, S>& m;
  const body_node<P>& at(int i) const { return f.nodes[static_cast<std::size_t>(i)]; }
  int count() const { return static_cast<int>(f.nodes.size()); }
  int parent(int i) const { return at(i).parent - f.bases; }  // bases come first
  int first(int i) const { return at(i).first; }
  int axes(int i) const { return at(i).axes; }
  const vec3<S>& step(int i) const { return m.world[static_cast<std::size_t>(f.bases + i)].step; }
};
/// `coriolis_terms` for body nodes. Call `place_in_world` first, with `rate` and the velocities of bases in `bodies`,
/// in the axes of the world.
template <class P, class S, class Put>
void coriolis_of_tree(const body_tree<P>& f, memory<P, S>& m, const Put& put) {
  std::vector<coriolis_body<S>> all(f.nodes.size());
  std::vector<world_axis<S>> changes(f.axes());
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const std::size_t slot = static_cast<std::size_t>(f.bases) + i, first = static_cast<std::size_t>(r.first),
                      end = first + static_cast<std::size_t>(r.axes);
    const world_place<S>& place = m.world[slot];
    const body_motion<S>& on = m.bodies[static_cast<std::size_t>(r.parent)];
    vec3<S> v = on.velocity + cross(on.ang_velocity, place.step), w = on.ang_velocity;
    for (std::size_t k = first; k < end; ++k)
      v = v + m.rate[k] * m.axes[k].linear, w = w + m.rate[k] * m.axes[k].angular;
    m.bodies[slot].velocity = v, m.bodies[slot].ang_velocity = w;
    for (std::size_t k = first; k < end; ++k) {
      changes[k] = change_of(m.axes[k], v, w);
      if (r.moves != joint::varying) [[likely]]
        continue;
      const world_axis<S> own = rate_of_axis(r, m.joint_transforms[i], static_cast<int>(k - first), &m.rate[first]);
      changes[k] = {changes[k].linear + place.rotation * own.linear, changes[k].angular + place.rotation * own.angular};
    }
    all[i] = coriolis_of<S>({S(r.weight.mass), place.rotation * as<S>(r.weight.moment),
                             as<S>(congruence(place.rotation, as<S>(r.weight.inertia)))},
                            v, w);
  }
  coriolis_terms(nodes_as_tree<P, S>{f, m}, m.axes.data(), changes.data(), all.data(), put);
}

}  // namespace kte::tree
