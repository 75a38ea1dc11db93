#pragma once

#include <kte/tree/memory.hpp>

namespace kte::engine {

/// The motion of a frame of a body: position and rotation in the world, other quantities in axes of the frame. Found by
/// argument-dependent lookup: dual numbers have their own function (tree/dual_motion.hpp).
template <class R, class V, class S, class P>
auto motion_of_frame(const world_placement<R, V, V>& place, const body_motion<S, S, S, S>& b,
                     const pose<mat3<vec3<P>>, vec3<P>>& at) {
  return compose(motion{place.position, place.rotation, b.velocity, b.ang_velocity, b.acceleration, b.ang_acceleration},
                 at_rest(at.rotation, at.position));
}

}  // namespace kte::engine
