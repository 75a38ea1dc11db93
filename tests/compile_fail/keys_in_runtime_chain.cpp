// mistakes: 2
// expect: error: .*kte: a runtime chain is connected by texts
// expect: error: .*kte: gravity is a vector
#include <kte/elements/revolute_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

void keys(kte::runtime_chain& arm) { arm << kte::revolute_joint_3D(q, base, elbow); }
void number(kte::runtime_chain& arm) { arm.gravity(-9.81) << kte::revolute_joint_3D("q", "base", "elbow"); }
