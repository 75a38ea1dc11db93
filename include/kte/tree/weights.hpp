#pragma once

#include <kte/tree/newton_euler.hpp>

/// The forces of gravity on the coordinates of a tree: inverse dynamics of bodies at rest, on bases that do not turn.
namespace kte::tree {

/// The motions of bodies at rest, as values of recursions (engine/looped.hpp): all but accelerations are typed zeros.
template <class S>
struct motions_at_rest {
  const body_motion<S>* motions;  ///< of bodies
  KTE_INLINE auto at(int i) const { return engine::body_motion{skip{}, zero3{}, motions[i].acceleration, zero3{}}; }
  template <engine::body B>
  KTE_INLINE auto of(int i) const {
    return at(i);
  }
};
/// Writes the power of the weights that each joint carries on each of its axes to `force`. With h = m c,
///
///   a_i = R^T a,   f = m a_i,   n = h x a_i          at rest: (3), (4) of recursions/newton_euler.hpp
template <class P, class S>
void transmit_weights(const body_tree<P>& f, memory<P, S>& m) {
  using hand = engine::body_motion<skip, skip, vec3<S>, skip>;
  const tree_bodies<P, S> bodies(f, m.joint_transforms);
  const engine::looped<tree_bodies<P, S>> driver{bodies};
  (void)driver.template outward<hand>(m.bodies.data(), [](const auto& b, const auto& parent) KTE_INLINE_LAMBDA {
    return engine::body_motion{skip{}, skip{}, b.in(parent.acceleration), skip{}};
  });
  engine::transmit<false>(driver, m.wrenches.data(), motions_at_rest<S>{m.bodies.data() + f.bases},
                          engine::wrench_under{engine::no_load{}}, m.force.data());
}

}  // namespace kte::tree
