#pragma once

#include <limits>

#include "catch.hpp"
#include "chain/models.hpp"
#include "random.hpp"

/// A chain with coordinates of all kinds, and random configurations of it.
namespace kte::test::configurations {

// clang-format off
inline constexpr struct elbow_  final : coord_key<"elbow">      {} elbow;
inline constexpr struct trunk_  final : pose_3D_key<"trunk">    {} trunk;
inline constexpr struct ball_   final : rotation_3D_key<"ball"> {} ball;
inline constexpr struct slide_  final : coord_key<"slide">      {} slide;
inline constexpr struct puck_   final : pose_2D_key<"puck">     {} puck;
inline constexpr struct ground_ final : frame_3D_key<"ground">  {} ground;
inline constexpr struct arm_    final : frame_3D_key<"arm">     {} arm;
inline constexpr struct body_   final : frame_3D_key<"body">    {} body;
inline constexpr struct hand_   final : frame_3D_key<"hand">    {} hand;
inline constexpr struct tip_    final : frame_3D_key<"tip">     {} tip;
inline constexpr struct table_  final : frame_2D_key<"table">   {} table;
inline constexpr struct disc_   final : frame_2D_key<"disc">    {} disc;
// clang-format on

/// Coordinates of all kinds, one moving on the other, and a puck on a separate table.
inline constexpr auto model =
    chain(revolute_joint_3D(elbow, ground, arm, axis::x), inertia_3D(arm, point_mass(1.0, along_y(0.5))),
          free_joint_3D(trunk, arm, body), inertia_3D(body, rigid_body{2.0, along_x(0.1), diagonal(0.2, 0.3, 0.4)}),
          spherical_joint_3D(ball, body, hand),
          inertia_3D(hand, rigid_body{1.0, along_z(0.3), diagonal(0.1, 0.1, 0.1)}),
          prismatic_joint_3D(slide, hand, tip, axis::y), inertia_3D(tip, point_mass(0.5)), base_2D(table),
          free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(0.3, 0.02)))
        .gravity(along_z(-9.81));
inline constexpr int nq = decltype(model)::nq, nv = decltype(model)::dofs;

inline constexpr double eps = std::numeric_limits<double>::epsilon();

template <class S, int N>
joint_vector<S, N> random_vector(random_numbers& random, double size) {
  joint_vector<S, N> x;
  for (auto& e : x) e = S(random(size));
  return x;
}
/// From where nothing is turned by constant v, so that its quaternions are of length 1.
template <class S>
joint_vector<S, nq> random_configuration(random_numbers& random) {
  return integrate(model, neutral_configuration<S>(model), random_vector<S, nv>(random, 2), S(1));
}

}  // namespace kte::test::configurations
