#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// Lengths of an arm z -y -y z -y z with a spherical wrist, m, all along z at q = 0: `base` from joint 1 to 2,
/// `upper_arm` from 2 to 3, `forearm` from 3 to 4, `wrist` from 4 to 5, `tool` from 5 to 6, where the tool frame is.
struct three_r_three_r_lengths {
  double base = 0, upper_arm = 1, forearm = 0.5, wrist = 0.5, tool = 0.2;
};

namespace detail {
/// The arm with the given base frame.
template <key_type Frame>
constexpr auto three_r_three_r_on(const Frame& frame, const three_r_three_r_lengths& l) {
  using namespace arm_names;
  const auto rod = [](double m, double d) { return link_body(m, along_z(d), 0.05); };
  return chain(revolute_joint_3D(q1, frame, link1), inertia_3D(link1, rod(5, l.base)),
               revolute_joint_3D(q2, link1, link2, axis::minus_y).at(along_z(l.base)),
               inertia_3D(link2, rod(5, l.upper_arm)),
               revolute_joint_3D(q3, link2, link3, axis::minus_y).at(along_z(l.upper_arm)),
               inertia_3D(link3, rod(2, l.forearm)), revolute_joint_3D(q4, link3, link4).at(along_z(l.forearm)),
               inertia_3D(link4, rod(2, l.wrist)),
               revolute_joint_3D(q5, link4, link5, axis::minus_y).at(along_z(l.wrist)),
               inertia_3D(link5, rod(1, l.tool)), revolute_joint_3D(q6, link5, tool).at(along_z(l.tool)),
               inertia_3D(tool, rod(0.5, 0)))
      .gravity(along_z(-9.81));
}
}  // namespace detail

/// Six revolute joints, z -y -y z -y z. Masses are assumed: 5, 5, 2, 2, 1, 0.5 kg.
[[nodiscard]] constexpr auto three_r_three_r_chain(const three_r_three_r_lengths& lengths = {}) {
  return detail::three_r_three_r_on(arm_names::base, lengths);
}
/// Limits: half a turn in each direction.
[[nodiscard]] constexpr auto three_r_three_r_limits() {
  auto limits = unlimited(three_r_three_r_chain());
  limits.upper = detail::in_radians<6>({180, 180, 180, 180, 180, 180});
  limits.lower = detail::negated(limits.upper);
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto three_r_three_r(const three_r_three_r_lengths& lengths = {}) {
  return manipulator(three_r_three_r_chain(lengths), arm_names::tool, three_r_three_r_limits());
}

}  // namespace kte
