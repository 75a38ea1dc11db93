#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// The KUKA LBR iiwa 14 R820: seven revolute joints, z y z -y z y z. At q = 0 all are along z: the shoulder at 0.36 m,
/// the elbow 0.42 m from it, the wrist 0.40 m from the elbow, the flange ("tool") 0.126 m from the wrist. Inertias and
/// lengths are those of the manufacturer. At q = 0 the axes of all links are those of the base.
[[nodiscard]] constexpr auto iiwa14_chain() {
  using namespace arm_names;
  return chain(revolute_joint_3D(q1, base, link1).at(along_z(0.1575)),
               inertia_3D(link1, rigid_body{5.76, vec3{zero, -0.03, 0.12}, diagonal(0.033, 0.0333, 0.0123)}),
               revolute_joint_3D(q2, link1, link2, axis::y).at(along_z(0.2025)),
               inertia_3D(link2, rigid_body{6.35, vec3{-0.0003, 0.042, 0.059}, diagonal(0.0305, 0.011, 0.0304)}),
               revolute_joint_3D(q3, link2, link3).at(along_z(0.2045)),
               inertia_3D(link3, rigid_body{3.5, vec3{zero, 0.03, 0.13}, diagonal(0.025, 0.0238, 0.0076)}),
               revolute_joint_3D(q4, link3, link4, axis::minus_y).at(along_z(0.2155)),
               inertia_3D(link4, rigid_body{3.5, vec3{zero, -0.034, 0.067}, diagonal(0.017, 0.006, 0.0164)}),
               revolute_joint_3D(q5, link4, link5).at(along_z(0.1845)),
               inertia_3D(link5, rigid_body{3.5, vec3{-0.0001, -0.021, 0.076}, diagonal(0.01, 0.0087, 0.00449)}),
               revolute_joint_3D(q6, link5, link6, axis::y).at(along_z(0.2155)),
               inertia_3D(link6, rigid_body{1.8, vec3{zero, 0.0004, 0.0006}, diagonal(0.0049, 0.0036, 0.0047)}),
               revolute_joint_3D(q7, link6, link7).at(along_z(0.081)),
               inertia_3D(link7, rigid_body{1.2, along_z(0.02), diagonal(0.001, 0.001, 0.001)}),
               rigid_link_3D(link7, tool, along_z(0.045)))
      .gravity(along_z(-9.81));
}

/// Limits of position, rate and torque, from the manufacturer's data sheet.
[[nodiscard]] constexpr auto iiwa14_limits() {
  auto limits = unlimited(iiwa14_chain());
  limits.upper = detail::in_radians<7>({170, 120, 170, 120, 170, 120, 175});
  limits.lower = detail::negated(limits.upper);
  limits.rate = detail::in_radians<7>({85, 85, 100, 75, 130, 135, 135});
  limits.effort = {320, 320, 176, 176, 110, 40, 40};
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto iiwa14() { return manipulator(iiwa14_chain(), arm_names::tool, iiwa14_limits()); }

}  // namespace kte
