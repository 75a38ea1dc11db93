#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// The European Robotic Arm: seven revolute joints, z y x x x y z, with links of 1.228, 0.340, 4.072, 4.072, 0.340,
/// 1.228 m along z at q = 0. ESA publishes a mass of 630 kg for the whole arm and a reach of 9.7 m, but no masses of
/// links. Here links are rods with assumed masses that sum to 630 kg.
[[nodiscard]] constexpr auto era_chain() {
  using namespace arm_names;
  const auto rod = [](double m, double d) { return link_body(m, along_z(d), 0.12); };
  return chain(revolute_joint_3D(q1, base, link1), inertia_3D(link1, rod(80, 1.228)),
               revolute_joint_3D(q2, link1, link2, axis::y).at(along_z(1.228)), inertia_3D(link2, rod(45, 0.340)),
               revolute_joint_3D(q3, link2, link3, axis::x).at(along_z(0.340)), inertia_3D(link3, rod(190, 4.072)),
               revolute_joint_3D(q4, link3, link4, axis::x).at(along_z(4.072)), inertia_3D(link4, rod(190, 4.072)),
               revolute_joint_3D(q5, link4, link5, axis::x).at(along_z(4.072)), inertia_3D(link5, rod(45, 0.340)),
               revolute_joint_3D(q6, link5, link6, axis::y).at(along_z(0.340)), inertia_3D(link6, rod(60, 1.228)),
               revolute_joint_3D(q7, link6, tool).at(along_z(1.228)), inertia_3D(tool, rod(20, 0)));
}
/// Limits: half a turn in each direction, 3/4 of that for the elbow.
[[nodiscard]] constexpr auto era_limits() {
  auto limits = unlimited(era_chain());
  limits.upper = detail::in_radians<7>({180, 180, 180, 135, 180, 180, 180});
  limits.lower = detail::negated(limits.upper);
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto era() { return manipulator(era_chain(), arm_names::tool, era_limits()); }

}  // namespace kte
