// expect: error: .*kte: items of the state of a static chain are named by keys
#include <kte/elements/revolute_joint.hpp>
#include <kte/static_chain/static_chain.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow));
double x() {
  auto s = kte::make_state(arm);
  return s["elbow"].position.x;
}
