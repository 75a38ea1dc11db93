#pragma once

#include <kte/manipulators/free_floater.hpp>

namespace kte {

/// An unmanned aerial vehicle as a free body under gravity: 1 kg, with assumed moments of inertia of a small quadrotor.
/// Model thrust and moments of the rotors as forces on the frame `body`.
template <class P = zero3, class R = no_rotation>
[[nodiscard]] constexpr auto uav_chain(const P& tool_position = {}, const R& tool_rotation = {}) {
  return free_floater_chain(tool_position, tool_rotation, rigid_body{1.0, zero3{}, diagonal(0.01, 0.01, 0.02)})
      .gravity(along_z(-9.81));
}

/// The manipulator of `uav_chain`, with these arguments.
template <class... Arguments>
[[nodiscard]] constexpr auto uav(const Arguments&... arguments) {
  return manipulator(uav_chain(arguments...), arm_names::tool);
}

}  // namespace kte
