// expect: error: .*kte: an element other than its joint acts on a coordinate to be locked
#include <kte/dynamics/reduced.hpp>
#include <kte/kte.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct p_     final : kte::coord_key<"p">         {} p;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
inline constexpr struct hand_  final : kte::frame_3D_key<"hand">   {} hand;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow), kte::revolute_joint_3D(p, elbow, hand),
                                kte::inertia_3D(hand, kte::point_mass(1.0)), kte::spring_gen(q, p, 0.0, 10.0));
double x(const double (&two)[2]) { return kte::reduced(arm, two, q).dofs; }
