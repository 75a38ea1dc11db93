#pragma once

#include <kte/recursions/newton_euler.hpp>

/// The placements of bodies and joint axes in the world, and motions of frames there.
namespace kte::engine {

/// The placement of a body: its axes as columns of a matrix, its origin relative to that of its parent and to that of
/// the world, in axes of the world.
template <class R, class P, class Q>
struct world_placement {
  using geometry = world_placement;
  R rotation;
  P step;
  Q position;
};
template <class R, class P, class Q>
world_placement(R, P, Q) -> world_placement<R, P, Q>;

/// Outward: A_i = A R,   p_i = p + A r          for a body at R, r on a parent at A, p
template <body B, class W>
KTE_INLINE constexpr auto placed_in_world(const B& b, const W& parent) {
  const auto& a = parent.rotation;
  const auto step = a * b.position();
  return world_placement{mat3{b.in(a.x), b.in(a.y), b.in(a.z)}, step, parent.position + step};
}
/// Writes the axes of a joint in axes of the world, A s_k, to axes[0], ...
template <body B, class R, class Axis>
KTE_INLINE constexpr void axes_in_world(const B& b, const R& rotation, Axis* axes) {
  each_axis(b, [&](const auto& k, const auto& s) KTE_INLINE_LAMBDA {
    assign(axes[k].linear, rotation * s.linear), assign(axes[k].angular, rotation * s.angular);
  });
}
/// All bodies, from the placements of bases in `kept`; with `axes` also the axes of joints.
template <class Hand, class Driver, class Kept, class... Axis>
KTE_INLINE void world_placements(const Driver& d, const Kept& kept, Axis*... axes) {
  (void)d.template outward<Hand>(kept, [axes...](const body auto& b, const auto& parent) KTE_INLINE_LAMBDA {
    const auto x = placed_in_world(b, parent);
    (axes_in_world(b, x.rotation, axes + b.first()), ...);
    return x;
  });
}

/// The motion of a frame of a body: position and rotation in the world, other quantities in axes of the frame. Found by
/// argument-dependent lookup: dual numbers have their own function (tree/dual_motion.hpp).
template <class R, class V, class S, class P>
auto motion_of_frame(const world_placement<R, V, V>& place, const body_motion<S, S, S, S>& b,
                     const pose<mat3<vec3<P>>, vec3<P>>& at) {
  return compose(motion{place.position, place.rotation, b.velocity, b.ang_velocity, b.acceleration, b.ang_acceleration},
                 at_rest(at.rotation, at.position));
}

}  // namespace kte::engine
