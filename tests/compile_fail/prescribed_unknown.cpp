// expect: error: .*kte: this chain has no coordinate of this name
// expect: elbow_angle_
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_           final : kte::coord_key<"q">            {} q;
inline constexpr struct elbow_angle_ final : kte::coord_key<"elbow_angle">  {} elbow_angle;
inline constexpr struct base_        final : kte::frame_3D_key<"base">      {} base;
inline constexpr struct elbow_       final : kte::frame_3D_key<"elbow">     {} elbow;
// clang-format on

constexpr auto arm =
    kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::inertia_3D(elbow, kte::point_mass(1.0, kte::along_x(0.5))));
double x(const double (&one)[1]) { return kte::hybrid_dynamics(arm, one, one, one, kte::prescribed(elbow_angle)).a[0]; }
