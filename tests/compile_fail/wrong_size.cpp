// mistakes: 3
// expect: error: .*kte: the size of q differs from that of a configuration of the chain
// expect: error: .*kte: the size of an argument .v, a, tau. differs from the number of degrees of freedom of the chain
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/elements/revolute_joint.hpp>

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">         {} q;
inline constexpr struct base_  final : kte::frame_3D_key<"base">   {} base;
inline constexpr struct elbow_ final : kte::frame_3D_key<"elbow">  {} elbow;
// clang-format on

constexpr auto arm = kte::chain(kte::revolute_joint_3D(q, base, elbow));
using one = std::array<double, 1>;
using two = std::array<double, 2>;
auto positions(const two& q, const one& v) { return kte::inverse_dynamics(arm, q, v, v); }
double as_array(const double (&q)[2], const one& v) { return kte::inverse_dynamics(arm, q, v, v)[0]; }
auto rates(const one& q, const two& v) { return kte::inverse_dynamics(arm, q, v, q); }
