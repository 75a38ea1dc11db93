// A chain with elements for controllers, in the algorithms that need loads to be those of motions.
// clang-format off
// mistakes: 3
// expect: error: .*kte: this element returns loads that are not the dual of its motion, for controllers
// expect: virtual_kte_interface<kte::kind::frame_3D>
// expect: virtual_kte_interface<kte::kind::gen>
// expect: vmc_revolute_joint<
// clang-format on
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct z_     final : kte::coord_key<"z">         {} z;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct ghost_ final : kte::frame_3D_key<"ghost">  {} ghost;
// clang-format on

constexpr auto swing = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::virtual_kte_interface_3D(elbow, ghost),
                                  kte::inertia_3D(ghost, kte::point_mass(1.0)));
constexpr auto wheel =
    kte::chain(kte::inertia_gen(q, 1.0), kte::virtual_kte_interface_gen(q, z), kte::inertia_gen(z, 2.0));
constexpr auto knee = kte::chain(kte::vmc_revolute_joint_3D(q, base, elbow, kte::axis::y, 0.01, 0.02),
                                 kte::inertia_3D(elbow, kte::point_mass(1.0, kte::along_x(0.5))));
using x = std::array<double, 1>;
auto fine(const x& y) { return kte::inverse_dynamics(swing, y, y, y) + kte::inverse_dynamics(wheel, y, y, y); }
auto f0(const x& y) { return kte::forward_dynamics(swing, y, y, y); }
auto f1(const x& y) { return kte::mass_matrix(wheel, y); }
auto f2(const x& y) { return kte::forward_dynamics(knee, y, y, y); }
