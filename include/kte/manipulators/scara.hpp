#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// A SCARA: two revolute joints about z with links along x, a prismatic joint along z (`q3`, m), the offset h of the
/// tool along z, and a revolute joint about z. Every link has 1 kg. There are no limits.
[[nodiscard]] constexpr auto scara_chain(double length1 = 1, double length2 = 1, double h = 0) {
  using namespace arm_names;
  const auto ball = rigid_body{1.0, zero3{}, diagonal(0.001, 0.001, 0.001)};
  return chain(revolute_joint_3D(q1, base, link1), inertia_3D(link1, link_body(1, along_x(length1), 0.05)),
               revolute_joint_3D(q2, link1, link2).at(along_x(length1)),
               inertia_3D(link2, link_body(1, along_x(length2), 0.05)),
               prismatic_joint_3D(q3, link2, link3, axis::z).at(along_x(length2)), inertia_3D(link3, ball),
               revolute_joint_3D(q4, link3, tool).at(along_z(h)), inertia_3D(tool, ball))
      .gravity(along_z(-9.81));
}

/// The manipulator of `scara_chain`, with these arguments.
template <class... Number>
[[nodiscard]] constexpr auto scara(const Number&... lengths) {
  return manipulator(scara_chain(lengths...), arm_names::tool);
}

}  // namespace kte
