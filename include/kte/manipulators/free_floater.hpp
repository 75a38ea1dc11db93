#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// A body that moves freely in space by the coordinate "pose", with its tool at a position, m, and rotation in the
/// body. By default a ball of 1 kg and 0.1 m. There are no limits.
template <class P = zero3, class R = no_rotation, class Body = decltype(link_body(1, zero3{}, 0.1))>
[[nodiscard]] constexpr auto free_floater_chain(const P& position = {}, const R& rotation = {},
                                                const Body& b = link_body(1, zero3{}, 0.1)) {
  using namespace arm_names;
  return chain(free_joint_3D(floating, base, body), inertia_3D(body, b), rigid_link_3D(body, tool, position, rotation));
}
/// A body that moves freely in the plane by the coordinate "pose", with its tool at a position, m, and rotation in the
/// body; mass m, kg, and moment of inertia izz, kg m^2.
template <class P = zero3>
[[nodiscard]] constexpr auto free_floater_2D_chain(const P& position = {}, double m = 1, double izz = 0.004) {
  using namespace planar_arm_names;
  return chain(free_joint_2D(floating, base, body), inertia_2D(body, planar_body(m, izz)),
               rigid_link_2D(body, tool, position));
}

/// The manipulator of `free_floater_chain`, with these arguments.
template <class... Arguments>
[[nodiscard]] constexpr auto free_floater(const Arguments&... arguments) {
  return manipulator(free_floater_chain(arguments...), arm_names::tool);
}
/// The manipulator of `free_floater_2D_chain`, with these arguments.
template <class... Arguments>
[[nodiscard]] constexpr auto free_floater_2D(const Arguments&... arguments) {
  return manipulator(free_floater_2D_chain(arguments...), planar_arm_names::tool);
}

}  // namespace kte
