// expect: error: .*kte: call it as inertia_3D.frame, body.; a body is
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/static_chain/static_chain.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::inertia_3D(elbow, 1.0));
