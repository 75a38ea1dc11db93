#include "dynamics/tree_motion.hpp"

// Chains that articulated bodies must leave to the mass matrix.

namespace articulated_not_test {

using namespace kte;
using namespace kte::test::trees;

TEST_CASE("chains that are no trees of joints") {
  constexpr auto shared =
      chain(revolute_joint_3D(q1, base, a, axis::y), inertia_3D(a, body), prismatic_joint_3D(q2, a, b, axis::x),
            inertia_3D(b, light), prismatic_joint_3D(q2, a, c, axis::minus_x), inertia_3D(c, body),
            revolute_joint_3D(q1, c, d, oblique), inertia_3D(d, light), spring_3D(b, c, 0.5, 10.0))
          .gravity(fall);
  STATIC_REQUIRE(!by_articulated_bodies<decltype(shared)>);
  check(shared, 6, usual, base);
  STATIC_REQUIRE(!by_articulated_bodies<decltype(models::tree)>);
  check(models::tree, 7, usual, models::ground, models::wall, models::motor);
  constexpr auto follower =
      chain(rigid_link_gen(q1, lone, 0.5), inertia_gen(lone, 0.75), revolute_joint_3D(q1, base, a), inertia_3D(a, body))
          .gravity(fall);
  STATIC_REQUIRE(!by_articulated_bodies<decltype(follower)>);
  check(follower, 8, usual, base);
}

}  // namespace articulated_not_test
