// expect: kte: parts of a chain have different gravities
// expect: error:
// expect: arm, tool

#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow)).gravity(kte::along_z(-9.81));
constexpr auto tool = kte::chain(kte::rigid_link_3D(elbow, hand, kte::along_z(0.5))).gravity(kte::along_x(1.62));
constexpr auto whole = kte::chain(arm, tool);
