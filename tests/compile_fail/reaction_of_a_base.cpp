// expect: error: .*kte: no joint or link moves this frame
#include <kte/dynamics/joint_reactions.hpp>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm =
    kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::inertia_3D(elbow, kte::point_mass(1.0, kte::along_x(0.5))));
double x(const double (&one)[1]) { return kte::joint_reaction(arm, one, one, one, base).force.x; }
