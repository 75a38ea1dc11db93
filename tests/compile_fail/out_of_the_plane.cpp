// expect: error: .*kte: a position in the plane has no z
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
inline constexpr struct flat_  final : kte::frame_2D_key<"flat">   {} flat;
inline constexpr struct other_ final : kte::frame_2D_key<"other">  {} other;
// clang-format on

constexpr auto bar = kte::rigid_link_2D(flat, other, kte::along_z(0.5));
