// expect: error: .*kte: hybrid dynamics is for chains in which no coordinate follows another or moves two joints
#include <kte/dynamics/hybrid_dynamics.hpp>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_      final : kte::coord_key<"q">         {} q;
inline constexpr struct geared_ final : kte::coord_key<"geared">    {} geared;
inline constexpr struct base_   final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_  final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::rigid_link_gen(q, geared, 0.5), kte::revolute_joint_3D(geared, base, elbow),
                                kte::inertia_3D(elbow, kte::point_mass(1.0, kte::along_x(0.5))));
double x(const double (&one)[1]) { return kte::hybrid_dynamics(arm, one, one, one, kte::prescribed(q)).a[0]; }
