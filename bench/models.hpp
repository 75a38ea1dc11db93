#pragma once

#include "data/iiwa14.hpp"
#include "data/ur5.hpp"
#include "robots/iiwa14.hpp"
#include "robots/ur5.hpp"

/// The mechanisms that are timed.
namespace bench {

namespace pendulum_names {
// clang-format off
inline constexpr struct q_ final : kte::coord_key<"q"> {} q;
inline constexpr struct base_ final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct arm_ final : kte::frame_2D_key<"arm"> {} arm;
inline constexpr struct tool_ final : kte::frame_2D_key<"tool"> {} tool;
// clang-format on
}  // namespace pendulum_names

/// A mass point on a massless rod, in the plane: kg, m, m/s^2.
struct pendulum {
  static constexpr auto name = "pendulum";
  static constexpr int dofs = 1;
  static constexpr double mass = 1.5, length = 0.75, gravity = 9.81;
  static constexpr auto& tool = pendulum_names::tool;
  static constexpr auto chain =
      kte::chain(kte::revolute_joint_2D(pendulum_names::q, pendulum_names::base, pendulum_names::arm),
                 kte::rigid_link_2D(pendulum_names::arm, tool, kte::along_x(length)),
                 kte::inertia_2D(tool, kte::point_mass(mass)))
          .gravity(kte::along_y(-gravity));
};
struct iiwa14 {
  static constexpr auto name = "iiwa14";
  static constexpr int dofs = 7;
  static constexpr auto& chain = robots::iiwa14;
  static constexpr auto& tool = robots::iiwa14_names::tool;
  static constexpr auto& reference = kte::reference::iiwa14;
};
struct ur5 {
  static constexpr auto name = "ur5";
  static constexpr int dofs = 6;
  static constexpr auto& chain = robots::ur5;
  static constexpr auto& tool = robots::ur5_names::tool;
  static constexpr auto& reference = kte::reference::ur5;
};

}  // namespace bench
