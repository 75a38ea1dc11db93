#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// Three revolute joints in the plane, with links along x of the given lengths, m. Every link is a rod of 1 kg; the
/// tool is at the end of the last. There are no limits.
[[nodiscard]] constexpr auto three_r_2D_chain(double length1 = 1, double length2 = 1, double length3 = 0) {
  using namespace planar_arm_names;
  const auto rod = [](double l) { return planar_body(1.0, l * l / 12 + 0.001, along_x(l / 2)); };
  return chain(revolute_joint_2D(q1, base, link1), inertia_2D(link1, rod(length1)),
               revolute_joint_2D(q2, link1, link2).at(along_x(length1)), inertia_2D(link2, rod(length2)),
               revolute_joint_2D(q3, link2, link3).at(along_x(length2)), inertia_2D(link3, rod(length3)),
               rigid_link_2D(link3, tool, along_x(length3)));
}

/// Three revolute joints about z in space; each link is (length, 0, offset), m, with 1 kg. There are no limits.
[[nodiscard]] constexpr auto three_r_chain(double length1 = 1, double length2 = 1, double length3 = 0,
                                           double offset1 = 0, double offset2 = 0, double offset3 = 0) {
  using namespace arm_names;
  const vec3 d1{length1, zero, offset1}, d2{length2, zero, offset2}, d3{length3, zero, offset3};
  return chain(revolute_joint_3D(q1, base, link1), inertia_3D(link1, link_body(1, d1, 0.05)),
               revolute_joint_3D(q2, link1, link2).at(d1), inertia_3D(link2, link_body(1, d2, 0.05)),
               revolute_joint_3D(q3, link2, link3).at(d2), inertia_3D(link3, link_body(1, d3, 0.05)),
               rigid_link_3D(link3, tool, d3))
      .gravity(along_z(-9.81));
}

/// The manipulator of `three_r_2D_chain`, with these arguments.
template <class... Number>
[[nodiscard]] constexpr auto three_r_2D(const Number&... lengths) {
  return manipulator(three_r_2D_chain(lengths...), planar_arm_names::tool);
}
/// The manipulator of `three_r_chain`, with these arguments.
template <class... Number>
[[nodiscard]] constexpr auto three_r(const Number&... lengths) {
  return manipulator(three_r_chain(lengths...), arm_names::tool);
}

}  // namespace kte
