#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// The Space Station Remote Manipulator System (Canadarm2): seven revolute joints, z -y z z z -y z, with booms of 6.85
/// m along x at q = 0. The last three frames are rotated by half a turn about x. Masses and principal moments are those
/// of Nguyen, Hughes (Journal of Guidance, Control and Dynamics 17, 1994), converted to axes along the links; those of
/// the other links follow by symmetry. Centres of mass in the middle of links and zero products of inertia are assumed.
[[nodiscard]] constexpr auto ssrms_chain() {
  using namespace arm_names;
  constexpr double boom = 6.85, a = 0.38, d = 0.504, end = 0.635;
  return chain(revolute_joint_3D(q1, base, link1),
               inertia_3D(link1, rigid_body{105.98, along_y(-end / 2), diagonal(12.19, 3.061, 12.13)}),
               revolute_joint_3D(q2, link1, link2, axis::minus_y).at(along_y(-end)),
               inertia_3D(link2, rigid_body{105.98, vec3{a / 2, zero, d / 2}, diagonal(8.088, 8.446, 3.061)}),
               revolute_joint_3D(q3, link2, link3).at(vec3{a, zero, d}),
               inertia_3D(link3, rigid_body{314.88, vec3{boom / 2, zero, d / 2}, diagonal(15.41, 2094.71, 2103.19)}),
               revolute_joint_3D(q4, link3, link4).at(vec3{boom, zero, d}),
               inertia_3D(link4, rigid_body{279.2, vec3{boom / 2, zero, d / 2}, diagonal(9.522, 1966.28, 1966.28)}),
               revolute_joint_3D(q5, link4, link5).at(vec3{boom, zero, d}),
               inertia_3D(link5, rigid_body{105.98, along_x(a / 2), diagonal(3.061, 8.088, 8.446)}),
               revolute_joint_3D(q6, link5, link6, axis::minus_y).at(along_x(a)),
               inertia_3D(link6, rigid_body{105.98, along_y(-end / 2), diagonal(12.19, 3.061, 12.13)}),
               revolute_joint_3D(q7, link6, tool).at(along_y(-end), half_turn_x),
               inertia_3D(tool, rigid_body{243.66, zero3{}, diagonal(44.413, 44.413, 9.336)}));
}
/// Limits: 270 degrees in each direction, 4 degrees/s, 2332 Nm.
[[nodiscard]] constexpr auto ssrms_limits() {
  auto limits = unlimited(ssrms_chain());
  limits.upper = detail::in_radians<7>({270, 270, 270, 270, 270, 270, 270});
  limits.lower = detail::negated(limits.upper);
  limits.rate = detail::in_radians<7>({4, 4, 4, 4, 4, 4, 4});
  limits.effort = {2332, 2332, 2332, 2332, 2332, 2332, 2332};
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto ssrms() { return manipulator(ssrms_chain(), arm_names::tool, ssrms_limits()); }

}  // namespace kte
