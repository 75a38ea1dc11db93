#pragma once

#include <Eigen/Geometry>

#include "catch.hpp"
#include "chain/models.hpp"
#include "eigenvalues.hpp"
#include "random.hpp"

/// Bodies that float, and ball joints.
namespace kte::test::floating_bodies {

using test::eigenvalues_of;

// clang-format off
inline constexpr struct trunk_  final : pose_3D_key<"trunk">    {} trunk;
inline constexpr struct puck_   final : pose_2D_key<"puck">     {} puck;
inline constexpr struct ball_   final : rotation_3D_key<"ball"> {} ball;
inline constexpr struct q1_     final : coord_key<"q1">         {} q1;
inline constexpr struct q2_     final : coord_key<"q2">         {} q2;
inline constexpr struct q3_     final : coord_key<"q3">         {} q3;
inline constexpr struct ground_ final : frame_3D_key<"ground">  {} ground;
inline constexpr struct body_   final : frame_3D_key<"body">    {} body;
inline constexpr struct socket_ final : frame_3D_key<"socket">  {} socket;
inline constexpr struct hand_   final : frame_3D_key<"hand">    {} hand;
inline constexpr struct tip_    final : frame_3D_key<"tip">     {} tip;
inline constexpr struct gimbal_ final : frame_3D_key<"gimbal">  {} gimbal;
inline constexpr struct ring_   final : frame_3D_key<"ring">    {} ring;
inline constexpr struct table_  final : frame_2D_key<"table">   {} table;
inline constexpr struct rail_   final : frame_2D_key<"rail">    {} rail;
inline constexpr struct cart_   final : frame_2D_key<"cart">    {} cart;
inline constexpr struct disc_   final : frame_2D_key<"disc">    {} disc;
// clang-format on

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr vec3 weight{0.5, -1.5, -9.81};  // m/s^2, in no axis of anything

inline constexpr rigid_body brick{2.5, vec3{0.1, -0.2, 0.15}, sym3{0.3, 0.02, -0.03, 0.4, 0.05, 0.35}};
inline constexpr rigid_body stick{1.2, vec3{-0.05, 0.1, 0.3}, sym3{0.12, -0.01, 0.02, 0.1, 0.03, 0.06}};

/// A body alone.
inline constexpr auto lone = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick)).gravity(weight);
/// Two bodies that a ball joint connects, with a slide at the end.
inline constexpr auto pair_of_bodies =
    chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
          rigid_link_3D(body, socket, vec3{0.3, 0.1, -0.2}, quarter_turn_y), spherical_joint_3D(ball, socket, hand),
          inertia_3D(hand, stick), prismatic_joint_3D(q1, hand, tip, axis::y), inertia_3D(tip, point_mass(0.4)))
        .gravity(weight);
/// With a free joint that hangs on other joints, and springs that read positions.
inline constexpr auto hanging =
    chain(revolute_joint_3D(q1, ground, gimbal, axis::x), inertia_3D(gimbal, stick), free_joint_3D(trunk, gimbal, body),
          inertia_3D(body, brick), spherical_joint_3D(ball, body, hand), inertia_3D(hand, stick),
          spring_3D(gimbal, hand, 0.2, 30.0), damper_3D(ground, body, 2.0), torsion_spring_3D(ground, hand, 5.0))
        .gravity(weight);

template <class S, int N>
joint_vector<S, N> random_vector(random_numbers& random, double size) {
  joint_vector<S, N> x;
  for (auto& e : x) e = S(random(size));
  return x;
}
template <class Chain>
auto random_configuration(const Chain& c, random_numbers& random) {
  const auto v = random_vector<double, Chain::dofs>(random, 2);
  return joint_vector<double, Chain::nq>(integrate(c, neutral_configuration(c), v, 1.0));
}
template <class State>
void set_all(State& s, const auto& q, const auto& v, const auto& a) {
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
}
template <class A, class B>
double gap(const A& a, const B& b) {
  return (a - b).cwiseAbs().maxCoeff();
}
inline Eigen::Vector3d eigen(const vec3<>& v) { return {v.x, v.y, v.z}; }
inline Eigen::Matrix3d eigen(const mat3<>& m) {
  Eigen::Matrix3d r;
  r << eigen(m.x).transpose(), eigen(m.y).transpose(), eigen(m.z).transpose();
  return r;
}
inline Eigen::Matrix3d eigen(const sym3<>& m) { return eigen(as<double>(full(m))); }

}  // namespace kte::test::floating_bodies
