// expect: error:
// expect: mass_matrix_calc: this mass or coordinate is added twice
#include <kte/kte.hpp>
#include <kte/reak/mass_matrix_calc.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::inertia_3D(elbow, kte::point_mass(1.0)));
constexpr auto calc = kte::mass_matrix_calc(arm) << kte::moved_by(q) << kte::moved_by(q);
