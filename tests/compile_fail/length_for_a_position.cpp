// expect: error: .*kte: call it as rigid_link_3D.base, end, position.*position is a vector
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/static_chain/static_chain.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::rigid_link_3D(elbow, hand, 0.5));
