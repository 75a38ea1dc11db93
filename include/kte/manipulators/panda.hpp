#pragma once

#include <kte/manipulators/arm_names.hpp>
#include <kte/manipulators/link_body.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/static.hpp>

namespace kte {

/// The Franka Emika Panda: seven revolute joints, each about z of its own axes (modified Denavit-Hartenberg parameters
/// of the maker), flange ("tool") 0.107 m along z of the last. Bodies as identified by Gaz, Cognetti, Oliva, Robuffo
/// Giordano, De Luca (IEEE Robotics and Automation Letters 4, 2019), which are not the maker's.
[[nodiscard]] constexpr auto panda_chain() {
  using namespace arm_names;
  constexpr auto& x90 = quarter_turn_x;
  constexpr auto& minus_x90 = minus_quarter_turn_x;
  return chain(revolute_joint_3D(q1, base, link1).at(along_z(0.333)),
               inertia_3D(link1, rigid_body{4.970684, vec3{0.003875, 0.002081, -0.04762},
                                            sym3{0.70337, -0.000139, 0.006772, 0.70661, 0.019169, 0.009117}}),
               revolute_joint_3D(q2, link1, link2).at(zero3{}, minus_x90),
               inertia_3D(link2, rigid_body{0.646926, vec3{-0.003141, -0.02872, 0.003495},
                                            sym3{0.007962, -0.003925, 0.010254, 0.02811, 0.000704, 0.025995}}),
               revolute_joint_3D(q3, link2, link3).at(along_y(-0.316), x90),
               inertia_3D(link3, rigid_body{3.228604, vec3{0.027518, 0.039252, -0.066502},
                                            sym3{0.037242, -0.004761, -0.011396, 0.036155, -0.012805, 0.01083}}),
               revolute_joint_3D(q4, link3, link4).at(along_x(0.0825), x90),
               inertia_3D(link4, rigid_body{3.587895, vec3{-0.05317, 0.104419, 0.027454},
                                            sym3{0.025853, 0.007796, -0.001332, 0.019552, 0.008641, 0.028323}}),
               revolute_joint_3D(q5, link4, link5).at(vec3{-0.0825, 0.384, zero}, minus_x90),
               inertia_3D(link5, rigid_body{1.225946, vec3{-0.011953, 0.041065, -0.038437},
                                            sym3{0.035549, -0.002117, -0.004037, 0.029474, 0.000229, 0.008627}}),
               revolute_joint_3D(q6, link5, link6).at(zero3{}, x90),
               inertia_3D(link6, rigid_body{1.666555, vec3{0.060149, -0.014117, -0.010517},
                                            sym3{0.001964, 0.000109, -0.001158, 0.004354, 0.000341, 0.005433}}),
               revolute_joint_3D(q7, link6, link7).at(along_x(0.088), x90),
               inertia_3D(link7, rigid_body{0.735522, vec3{0.010517, -0.004252, 0.061597},
                                            sym3{0.012516, -0.000428, -0.001196, 0.010027, -0.000741, 0.004815}}),
               rigid_link_3D(link7, tool, along_z(0.107)))
      .gravity(along_z(-9.81));
}

/// Limits from the manufacturer's interface specification.
[[nodiscard]] constexpr auto panda_limits() {
  auto limits = unlimited(panda_chain());
  limits.lower = {-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973};
  limits.upper = {2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973};
  limits.rate = {2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61};
  limits.acceleration = {15, 7.5, 10, 12.5, 15, 20, 20};
  limits.jerk = {7500, 3750, 5000, 6250, 7500, 10000, 10000};
  limits.effort = {87, 87, 87, 87, 12, 12, 12};
  return limits;
}

/// The arm with its limits.
[[nodiscard]] constexpr auto panda() { return manipulator(panda_chain(), arm_names::tool, panda_limits()); }

}  // namespace kte
