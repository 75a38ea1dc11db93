// expect: kte: gravity must be finite
// expect: error:

#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow)).gravity(kte::along_z(__builtin_nan("")));
