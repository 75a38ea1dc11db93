// expect: error: .*kte: another key has the text of this name
// expect: other_
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
inline constexpr struct other_ final : kte::frame_3D_key<"base">   {} other;
// clang-format on

constexpr auto arm =
    kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::rigid_link_3D(elbow, other, kte::along_z(0.5)));
