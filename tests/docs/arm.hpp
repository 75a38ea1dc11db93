#pragma once

#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/static_chain/static_chain.hpp>

#include <array>

/// The arm that pages of the documentation take as given, in a position and in motion.
namespace docs::given {

// clang-format off
inline constexpr struct shoulder_  final : kte::coord_key<"shoulder">     {} shoulder;
inline constexpr struct elbow_     final : kte::coord_key<"elbow">        {} elbow;
inline constexpr struct motor_     final : kte::input_key<"motor">        {} motor;
inline constexpr struct base_      final : kte::frame_3D_key<"base">      {} base;
inline constexpr struct upper_     final : kte::frame_3D_key<"upper">     {} upper;
inline constexpr struct upper_end_ final : kte::frame_3D_key<"upper_end"> {} upper_end;
inline constexpr struct lower_     final : kte::frame_3D_key<"lower">     {} lower;
inline constexpr struct tool_      final : kte::frame_3D_key<"tool">      {} tool;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(shoulder, base, upper, kte::axis::y),
                                kte::rigid_link_3D(upper, upper_end, kte::along_x(0.4)),
                                kte::inertia_3D(upper_end, kte::point_mass(2.0)),
                                kte::revolute_joint_3D(elbow, upper_end, lower, kte::axis::y),
                                kte::rigid_link_3D(lower, tool, kte::along_x(0.3)),
                                kte::inertia_3D(tool, kte::point_mass(1.0)), kte::driving_actuator_gen(elbow, motor))
                         .gravity(kte::along_z(-9.81));

constexpr std::array q{0.3, -0.5}, v{0.0, 0.0};

}  // namespace docs::given
