// expect: error:
// expect: inertia must be physical: no principal moment above the sum of the other two
// expect: as_published.. is not checked
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm =
    kte::chain(kte::revolute_joint_3D(q, base, elbow),
               kte::inertia_3D(elbow, kte::rigid_body{1.0, kte::zero3{}, kte::diagonal(1.0, 1.0, 3.0)}));
