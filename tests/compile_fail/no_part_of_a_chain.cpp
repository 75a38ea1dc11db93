// mistakes: 3
// expect: error: .*kte: a static chain consists of elements and static chains; this argument is neither
// expect: error: .*kte: a chain consists of elements and chains; this argument is neither
// expect: error: .*kte: call it as point_mass.mass. or point_mass.mass, com
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, hand));

const auto whole = kte::chain(arm, 5);
void append(kte::runtime_chain& c) { c << 5; }
const auto tool = kte::inertia_3D(hand, kte::point_mass());
