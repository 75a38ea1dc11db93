#pragma once

#include <kte/elements/rigid_link.hpp>

namespace kte {

/// A fixed joint in the plane, as robot descriptions name it. It makes a `rigid_link`, also in files and messages.
template <class B, class E, geometric Position = zero3, class Rotation = no_rotation>
[[nodiscard]] constexpr auto fixed_joint_2D(const B& base, const E& end, const Position& position = {},
                                            const Rotation& rotation = {}) {
  return rigid_link_2D(base, end, position, rotation);
}
/// A fixed joint in space: a `rigid_link`.
template <class B, class E, class X = zero_t, class Y = zero_t, class Z = zero_t, class Rotation = no_rotation>
[[nodiscard]] constexpr auto fixed_joint_3D(const B& base, const E& end, const vec3<X, Y, Z>& position = {},
                                            const Rotation& rotation = {}) {
  return rigid_link_3D(base, end, position, rotation);
}

KTE_CALL(fixed_joint_2D, "(base, end[, position[, rotation]]); a position is a vector, such as kte::along_x(0.5)")
KTE_CALL(fixed_joint_3D, "(base, end[, position[, rotation]]); a position is a vector, such as kte::along_z(0.5)")

}  // namespace kte
