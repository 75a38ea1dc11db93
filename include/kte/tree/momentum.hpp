#pragma once

#include <kte/tree/composite.hpp>

namespace kte::tree {

/// The mass, and the mass times the position of the centre of mass.
template <class S>
struct mass_moment {
  S mass{};
  vec3<S> moment{};
};
/// The mass moment of all bodies in world axes. Call `place_in_world` and `carry_bodies` first.
template <class P, class S>
mass_moment<S> weight_in_world(const body_tree<P>& f, const memory<P, S>& m) {
  mass_moment<S> sum;
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b) {
    const auto& x = m.world[b];
    const auto& c = m.carried[b];
    sum = {sum.mass + c.mass, sum.moment + (x.rotation * c.moment + c.mass * x.position)};
  }
  return sum;
}
/// Calls put(k, momentum at the unit rate of axis k about a point, in world axes).
template <class P, class S, class Put>
void momenta(const body_tree<P>& f, const memory<P, S>& m, const vec3<S>& about, const Put& put) {
  const std::size_t bases = static_cast<std::size_t>(f.bases);
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    const world_place<S>& x = m.world[bases + i];
    const vec3<S> arm = x.position - about;
    for (int k = 0; k < r.axes; ++k) {
      const dense_wrench<S> own = accelerating(r, m.joint_transforms[i], k, m.carried[bases + i]);
      const vec3<S> p = x.rotation * own.force;
      put(r.first + k, dense_wrench<S>{p, x.rotation * own.torque + cross(arm, p)});
    }
  }
}

}  // namespace kte::tree
