#pragma once

#include <kte/elements/differential.hpp>
#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_backlash_mode.hpp>
#include <kte/elements/joint_stiction.hpp>
#include <kte/elements/law_signal.hpp>
#include <kte/elements/mimic.hpp>
#include <kte/elements/position_control.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/simulation.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"

/// A block with friction that holds, on a slope, and names for what acts on it.
namespace kte::test::held_block {

inline constexpr struct x_ final : coord_key<"x"> {
} x;
inline constexpr struct mode_ final : internal_key<"mode"> {
} rest;
inline constexpr struct second_ final : internal_key<"mode 2"> {
} second;
inline constexpr struct ground_ final : frame_2D_key<"ground"> {
} ground;
inline constexpr struct block_ final : frame_2D_key<"block"> {
} block;
inline constexpr struct wall_ final : coord_key<"wall"> {
} wall;
inline constexpr struct pull_ final : input_key<"pull"> {
} pull;
inline constexpr struct grip_ final : input_key<"grip"> {
} grip;

inline constexpr double g = 9.81, slope = std::numbers::pi / 6;

/// A block of 1 kg on a slope of 30 degrees; x points down.
inline auto on_slope(double coulomb, double stiction) {
  return chain(prismatic_joint_2D(x, ground, block, axis::x), inertia_2D(block, point_mass(1.0)),
               joint_stiction_gen(x, rest, {coulomb, stiction}))
      .gravity(vec3{g * std::sin(slope), -g * std::cos(slope), zero});
}

}  // namespace kte::test::held_block
