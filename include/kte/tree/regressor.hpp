#pragma once

#include <kte/recursions/regressor.hpp>
#include <kte/tree/coriolis.hpp>

namespace kte::tree {

/// The forces on all axes for the motion of a body fixed to a frame, by inertial parameters: put(k, y) for each axis k
/// between the frame and its base; y uses the column of axis k in the Jacobian of the frame. Call `move_bodies` and
/// `place_in_world` first.
template <class P, class S, class Put>
void forces_by_parameters(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, const Put& put) {
  const auto slot = static_cast<std::size_t>(frame.slot);
  const body_motion<S>& b = m.bodies[slot];
  const mat3<vec3<S>> rotation = as<S>(frame.at.rotation);
  const vec3<S> position = as<S>(frame.at.position);
  const auto x = compose(motion{skip{}, no_rotation{}, skip{}, b.ang_velocity, b.acceleration, b.ang_acceleration},
                         at_rest(rotation, position));
  const mat3<vec3<S>>& axes = m.world[slot].rotation;
  engine::forces_by_parameters(nodes_in_world<P, S>{f, m}, frame.slot - f.bases, mat3<vec3<S>>(axes * rotation),
                               vec3<S>(axes * position), x, put);
}

}  // namespace kte::tree
