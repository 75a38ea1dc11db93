#pragma once

#include <kte/recursions/regressor.hpp>
#include <kte/tree/jacobian.hpp>

namespace kte::tree {

/// The forces on all axes for the motion of a body fixed to a frame, by inertial parameters: put(k, y) for each axis k
/// between the frame and its base; y uses the column of axis k in the Jacobian of the frame. Call `move_bodies` first.
template <class P, class S, class Put>
void forces_by_parameters(const body_tree<P>& f, const memory<P, S>& m, const frame_place<P>& frame, const Put& put) {
  const body_motion<S>& b = m.bodies[static_cast<std::size_t>(frame.slot)];
  const auto x = compose(motion{skip{}, no_rotation{}, skip{}, b.ang_velocity, b.acceleration, b.ang_acceleration},
                         at_rest(as<S>(frame.at.rotation), as<S>(frame.at.position)));
  const auto columns = [&](const auto& column) {
    dense_pose<S> in_base;
    jacobian_columns(f, m, frame, in_base,
                     [&](int k, const auto& v, const auto& u) { column(k, components<S>(v), components<S>(u)); });
  };
  engine::forces_by_parameters<S>(x, columns, put);
}

}  // namespace kte::tree
