#pragma once

#include <kte/engine/looped.hpp>
#include <kte/tree/bodies.hpp>

/// Inverse dynamics of the body nodes of a tree (recursions/newton_euler.hpp).
namespace kte::tree {

/// The motions of all bodies from those of bases and axes, on request with linear velocities.
template <bool Velocities, class P, class S>
void move_bodies(const body_tree<P>& f, memory<P, S>& m) {
  using velocity = std::conditional_t<Velocities, vec3<S>, skip>;
  using hand = engine::body_motion<velocity, vec3<S>, vec3<S>, vec3<S>>;
  const tree_bodies<P, S> bodies(f, m.joint_transforms);
  (void)engine::motions<hand>(engine::looped<tree_bodies<P, S>>{bodies}, m.bodies.data(), m.rate.data(),
                              m.acceleration.data());
}
/// Body wrenches for known motions, minus `loads`, go inward to `wrenches`; their power on each axis is added to
/// `force`.
template <class P, class S, class Load>
void transmit_wrenches(const body_tree<P>& f, memory<P, S>& m, const Load& load) {
  const tree_bodies<P, S> bodies(f, m.joint_transforms);
  engine::transmit<true>(engine::looped<tree_bodies<P, S>>{bodies}, m.wrenches.data(),
                         engine::kept_array<body_motion<S>>{m.bodies.data() + f.bases}, engine::wrench_under{load},
                         m.force.data());
}

/// `loads` of the working memory, as an argument of `transmit_wrenches`.
template <class S>
struct load_of_slot {
  const dense_wrench<S>* loads;
  template <class B>
  KTE_INLINE const dense_wrench<S>& operator()(const B& b) const {
    return loads[b.slot];
  }
};
/// `transmit_wrenches` for loads only, without body wrenches.
template <class P, class S>
void transmit_loads(const body_tree<P>& f, memory<P, S>& m) {
  const tree_bodies<P, S> bodies(f, m.joint_transforms);
  engine::transmit<false>(engine::looped<tree_bodies<P, S>>{bodies}, m.wrenches.data(),
                          engine::kept_constant<engine::no_value>{},
                          engine::wrench_under{load_of_slot<S>{m.loads.data()}}, m.force.data());
}

}  // namespace kte::tree
