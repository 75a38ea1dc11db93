#pragma once

#include <kte/tree/memory.hpp>

namespace kte::tree {

/// The motion of a frame in a body: position and rotation in the world, the rest in axes of the frame.
template <class S, class P>
auto motion_of_frame(const world_place<S>& place, const body_motion<S>& b, const pose<mat3<vec3<P>>, vec3<P>>& at) {
  return compose(motion{place.position, place.rotation, b.velocity, b.ang_velocity, b.acceleration, b.ang_acceleration},
                 at_rest(at.rotation, at.position));
}

}  // namespace kte::tree
