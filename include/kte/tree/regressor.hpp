#pragma once

#include <kte/recursions/regressor.hpp>
#include <kte/tree/jacobian.hpp>

namespace kte::tree {

/// The forces on all axes for the motion of a body fixed to a frame, by inertial parameters: put(k, y) for each axis k
/// between the frame and its base; y uses the column of axis k in the Jacobian of the frame. Call `move_bodies` first.
/// `forces_by_parameters` for joints in the world (recursions/regressor.hpp) takes 1.25 times as long.
template <class P, class S, class Put>
void forces_by_parameters(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, const Put& put) {
  const body_motion<S>& b = m.bodies[static_cast<std::size_t>(frame.slot)];
  const auto x = compose(motion{skip{}, no_rotation{}, skip{}, b.ang_velocity, b.acceleration, b.ang_acceleration},
                         at_rest(as<S>(frame.at.rotation), as<S>(frame.at.position)));
  dense_pose<S> in_base;
  jacobian_columns(f, m, frame, in_base, [&](int k, const auto& v, const auto& u) {
    put(k, engine::power_by_parameters(x, components<S>(v), components<S>(u)));
  });
}

}  // namespace kte::tree
