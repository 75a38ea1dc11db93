#pragma once

#include <kte/engine/looped.hpp>
#include <kte/tree/newton_euler.hpp>

/// Forward dynamics of the body nodes of a tree by articulated bodies (recursions/articulated_body.hpp).
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
/// Bias accelerations of all bodies, from `rate` and the motions of bases; for prescribed joints with their
/// `acceleration`. The type of the result has typed zeros by the kind of joint.
template <class P, class S>
auto bias_motions(const body_tree<P>& f, memory<P, S>& m) {
  for (std::size_t b = 0; b < static_cast<std::size_t>(f.bases); ++b)
    m.biases[b].ang_velocity = m.bodies[b].ang_velocity;
  const articulated_bodies<P, S> bodies(f, m);
  return engine::bias_motions<bias_motion<S>>(engine::looped<articulated_bodies<P, S>>{bodies}, m.biases.data(),
                                              m.rate.data(), m.acceleration.data());
}
template <class P, class S>
using bias_motions_type = decltype(bias_motions(std::declval<const body_tree<P>&>(), std::declval<memory<P, S>&>()));
/// Articulated inertias and bias forces of all bodies under `force` on axes and `loads`, which are zero if no element
/// acts on frames. Writes `factors`. Returns the first axis that moves no mass, or -1. Call `bias_motions` first.
template <class P, class S, class Biases>
int articulate(const body_tree<P>& f, memory<P, S>& m, const Biases& biases) {
  const articulated_bodies<P, S> bodies(f, m);
  int unmoved = -1;
  engine::articulate<articulated_body<S>>(
      engine::looped<articulated_bodies<P, S>>{bodies}, m.articulated.data(), biases,
      [load = load_of_slot<S>{m.loads.data()}](const auto& b, const auto& x)
          KTE_INLINE_LAMBDA { return engine::velocity_wrench(b, x.ang_velocity) - load(b); },
      [force = m.force.data()](const auto& b)
          KTE_INLINE_LAMBDA { return [of_joint = force + b.first()](int k) KTE_INLINE_LAMBDA { return of_joint[k]; }; },
      m.factors.data(), unmoved);
  return unmoved;
}
/// As `articulate`, for articulated inertias only.
template <class P, class S>
int articulate_at_rest(const body_tree<P>& f, memory<P, S>& m) {
  const articulated_bodies<P, S> bodies(f, m);
  int unmoved = -1;
  engine::articulate_at_rest(engine::looped<articulated_bodies<P, S>>{bodies}, m.articulated.data(), m.factors.data(),
                             unmoved);
  return unmoved;
}
/// Accelerations of all bodies and axes, from the motions of bases. Call `articulate` first.
template <class P, class S, class Biases>
void accelerate(const body_tree<P>& f, memory<P, S>& m, const Biases& biases) {
  using hand = engine::body_motion<skip, vec3<S>, vec3<S>, vec3<S>>;
  const articulated_bodies<P, S> bodies(f, m);
  engine::accelerate<hand>(engine::looped<articulated_bodies<P, S>>{bodies}, m.bodies.data(), biases, m.factors.data(),
                           m.acceleration.data());
}

}  // namespace kte::tree
