#pragma once

#include <kte/engine/looped.hpp>
#include <kte/tree/newton_euler.hpp>

/// What the articulated-body algorithm (recursions/articulated_body.hpp) reads and keeps for the body nodes of a tree.
namespace kte::tree {

/// Sets which joints are free to move: is_free(number of a body node). The accelerations of others are prescribed.
template <class P, class S, class F>
void set_free(const body_tree<P>& f, memory<P, S>& m, const F& is_free) {
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const body_node<P>& r = f.nodes[i];
    m.is_free[i] = is_free(i);
    m.plain[i] =
        m.is_free[i] && r.moves == joint::revolute && all(m.own_mass[static_cast<std::size_t>(r.first)] == P(0));
  }
}
/// The bias motions of bodies in the memory of a state, with typed zeros by the kind of joint.
template <class S>
using bias_motions_of_bodies = engine::kept_values<bias_motion<S>, bias_motion<S>, engine::bias_motion_of_child<S>>;
/// The bias motions of `bodies`, from the rates of axes, and the accelerations of joints that are not free. Bases:
/// `bodies` of the memory.
template <class Bodies, class P, class S>
bias_motions_of_bodies<S> bias_motions(const Bodies& bodies, memory<P, S>& m) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(bodies.bases()); ++b)
    m.biases[b].ang_velocity = m.bodies[b].ang_velocity;
  return engine::bias_motions<bias_motion<S>>(engine::looped{bodies}, m.biases.data(), m.rate.data(),
                                              m.acceleration.data());
}
/// The wrench of a body at its angular velocity, less its load.
template <class S>
struct bias_wrench {
  load_of_slot<S> load;
  template <class B, class M>
  KTE_INLINE auto operator()(const B& b, const M& motion) const {
    return engine::velocity_wrench(b, motion.ang_velocity) - load(b);
  }
};
/// The forces on the axes of a body, by number.
template <class S>
struct forces_on_axes {
  const S* force;  ///< of all axes
  template <class B>
  KTE_INLINE auto operator()(const B& b) const {
    return [of_joint = force + b.first()](int k) KTE_INLINE_LAMBDA { return of_joint[k]; };
  }
};
/// Bodies in registers while their accelerations are found.
template <class S>
using accelerated_body = engine::body_motion<skip, vec3<S>, vec3<S>, vec3<S>>;

/// Articulated inertias of all bodies at rest, and `factors`. Returns the first axis that moves no mass, or -1.
template <class P, class S>
int articulate_at_rest(const body_tree<P>& f, memory<P, S>& m) {
  const articulated_bodies<P, S> bodies(f, m);
  int unmoved = -1;
  engine::articulate_at_rest(engine::looped{bodies}, m.articulated.data(), m.factors.data(), unmoved);
  return unmoved;
}

}  // namespace kte::tree
