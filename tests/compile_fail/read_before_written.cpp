// expect: error: .*kte: this element reads a name that only a later element writes: move it behind that element
// expect: rigid_link.*elbow_, hand_
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm =
    kte::chain(kte::inertia_3D(base, kte::point_mass(1.0)), kte::rigid_link_3D(elbow, hand, kte::along_z(0.5)),
               kte::revolute_joint_3D(q, base, elbow));
