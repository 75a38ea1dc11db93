#pragma once

#include "data/chain32.hpp"
#include "data/numbered_chain.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"
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
  static constexpr auto& chain = robots::iiwa14;
  static constexpr auto& tool = robots::iiwa14_names::tool;
};
struct ur5 {
  static constexpr auto name = "ur5";
  static constexpr auto& chain = robots::ur5;
  static constexpr auto& tool = robots::ur5_names::tool;
};
/// The tool is the foot of the reference values.
struct solo12 {
  static constexpr auto name = "solo12";
  static constexpr auto& chain = robots::solo12;
  static constexpr auto& tool = robots::solo12_names::hr.foot;
};

/// Body i, from 0, of all serial chains: 32 bodies over and over, so that serial2, serial8 and serial32 are the chains
/// of tests/data.
constexpr const kte::reference::serial_body& serial_body(int i) { return kte::reference::chain32_bodies[i % 32]; }

/// "serial8": apart from the chain, which takes its time to compile.
template <int N>
inline constexpr auto serial_name = kte::reference::numbered<"serial", N>();

/// A chain of N bodies with numbers for everything.
template <int N>
struct serial {
  static constexpr auto name = serial_name<N>.text;
  static constexpr auto& tool = kte::reference::numbered_names::link<N>;
  static constexpr auto chain = []<std::size_t... I>(std::index_sequence<I...>) {
    constexpr kte::reference::serial_body bodies[]{serial_body(I)...};
    return kte::reference::static_chain_of(bodies);
  }
  (std::make_index_sequence<N>{});
};

}  // namespace bench
