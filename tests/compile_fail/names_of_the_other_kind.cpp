// mistakes: 4
// expect: error: .*kte: items of a static chain are named by keys, forward_kinematics.arm, q, hand.. texts are for runtime chains
// expect: error: .*kte: items of a static chain are named by keys, frame_velocity.arm, q, v, hand.
// expect: error: .*kte: items of a runtime chain are named by texts, forward_kinematics.arm, s, q
// expect: error: .*kte: items of a runtime chain are named by texts, jacobian.arm, s, q
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, hand));
using numbers = std::array<double, 1>;

double pose(const numbers& x) { return kte::forward_kinematics(arm, x, "hand").position.x; }
double rate(const numbers& x) { return kte::frame_velocity(arm, x, x, std::string("hand")).linear.x; }
double pose(const kte::runtime_chain& c, kte::runtime_state& s, const numbers& x) {
  return kte::forward_kinematics(c, s, x, hand).position.x;
}
double column(const kte::runtime_chain& c, kte::runtime_state& s) { return kte::jacobian(c, s, hand)(0, 0); }
