#pragma once

#include <kte/engine/looped.hpp>
#include <kte/recursions/newton_euler.hpp>
#include <kte/tree/bodies.hpp>

namespace kte::tree {

/// The kinetic energy of all bodies but those on bases, J, from the rates of axes and the velocities of bases: a sum of
/// `kinetic_energy_of_body`.
template <class P, class S>
S kinetic_energy(const body_tree<P>& f, memory<P, S>& m) {
  using hand = engine::body_motion<vec3<S>, vec3<S>, skip, skip>;
  const tree_bodies<P, S> bodies(f, m.joint_transforms);
  S sum(0);
  const auto add = [&sum, rate = m.rate.data()](const auto& b, const auto& parent) KTE_INLINE_LAMBDA {
    const auto x = engine::moved_at_rate(b, parent, rate + b.first());
    sum += as<S>(kinetic_energy_of_body(b.inertia(), x.velocity, x.ang_velocity));
    return x;
  };
  (void)engine::looped<tree_bodies<P, S>>{bodies}.template outward<hand>(m.bodies.data(), add);
  return sum;
}

}  // namespace kte::tree
