// expect: error: .*kte: this element reads a name that no element of the chain writes: misspelt
// expect: rigid_link.*elbwo_
// expect: did_you_mean_key<elbwo_, elbow_>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
inline constexpr struct elbwo_ final : kte::frame_3D_key<"elbwo">  {} elbwo;
// clang-format on

constexpr auto arm =
    kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::rigid_link_3D(elbwo, hand, kte::along_z(0.5)));
