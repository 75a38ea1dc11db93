#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// Lengths of an arm of Universal Robots, m: `shoulder_height`, `shoulder_offset`, `upper_arm`, `elbow_offset`,
/// `forearm`, `wrist1`, `wrist2`, `wrist3`; by default those of the UR5.
struct ur_lengths {
  double shoulder_height = 0.089159, shoulder_offset = 0.13585, upper_arm = 0.425, elbow_offset = 0.1197,
         forearm = 0.39225, wrist1 = 0.093, wrist2 = 0.09465, wrist3 = 0.0823;
};

/// An arm of Universal Robots: six revolute joints, z y y y z y; joints 2, 3 and 4 are parallel. The upper arm is
/// horizontal at q = 0. Quarter turns are exact; the manufacturer's description has 1.57079632679 rad. Masses, centres
/// of mass and moments of inertia are the manufacturer's for the UR5.
[[nodiscard]] constexpr auto ur_chain(const ur_lengths& l = {}) {
  using namespace arm_names;
  constexpr auto wrist = diagonal(0.111172755531, 0.111172755531, 0.21942);
  return chain(revolute_joint_3D(q1, base, link1).at(along_z(l.shoulder_height)),
               inertia_3D(link1, rigid_body{3.7, zero3{}, diagonal(0.010267495893, 0.010267495893, 0.00666)}),
               revolute_joint_3D(q2, link1, link2, axis::y).at(along_y(l.shoulder_offset), quarter_turn_y),
               inertia_3D(link2, rigid_body{8.393, along_z(0.28), diagonal(0.22689067591, 0.22689067591, 0.0151074)}),
               revolute_joint_3D(q3, link2, link3, axis::y).at(vec3{zero, -l.elbow_offset, l.upper_arm}),
               inertia_3D(link3, rigid_body{2.275, along_z(0.25), diagonal(0.049443313556, 0.049443313556, 0.004095)}),
               revolute_joint_3D(q4, link3, link4, axis::y).at(along_z(l.forearm), quarter_turn_y),
               inertia_3D(link4, rigid_body{1.219, zero3{}, wrist}),
               revolute_joint_3D(q5, link4, link5).at(along_y(l.wrist1)),
               inertia_3D(link5, rigid_body{1.219, zero3{}, wrist}),
               revolute_joint_3D(q6, link5, link6, axis::y).at(along_z(l.wrist2)),
               inertia_3D(link6, rigid_body{0.1879, zero3{}, diagonal(0.0171364731454, 0.0171364731454, 0.033822)}),
               rigid_link_3D(link6, tool, along_y(l.wrist3), minus_quarter_turn_x))
      .gravity(along_z(-9.81));
}

/// Limits from the manufacturer's description of the UR5: two turns for each joint, one for the elbow.
[[nodiscard]] constexpr auto ur_limits() {
  auto limits = unlimited(ur_chain());
  limits.upper = detail::in_radians<6>({360, 360, 180, 360, 360, 360});
  limits.lower = detail::negated(limits.upper);
  limits.rate = {3.15, 3.15, 3.15, 3.2, 3.2, 3.2};
  limits.effort = {150, 150, 150, 28, 28, 28};
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto ur(const ur_lengths& lengths = {}) {
  return manipulator(ur_chain(lengths), arm_names::tool, ur_limits());
}

}  // namespace kte
