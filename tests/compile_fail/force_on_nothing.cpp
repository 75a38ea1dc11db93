// expect: error: .*kte: nothing moves by this coordinate of the element: misspelt
// expect: spring.*wall_
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
inline constexpr struct wall_  final : kte::coord_key<"wall">      {} wall;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::spring_gen(q, wall, 0.0, 10.0));
