// expect: error: .*kte: a joint or link in space turns by a matrix or a quaternion
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

const auto bar = kte::rigid_link_3D(base, hand, kte::along_z(0.5), kte::rotation_by(0.3));
