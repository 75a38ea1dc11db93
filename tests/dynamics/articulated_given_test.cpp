#include "dynamics/tree_motion.hpp"

// Forward dynamics by articulated bodies where the motion of a joint is given, and with masses on coordinates.

namespace articulated_given_test {

using namespace kte;
using namespace kte::test::trees;
using models::element_by_element;

TEST_CASE("given motion") {
  constexpr auto c = driven_3D(across);
  STATIC_REQUIRE(by_articulated_bodies<decltype(c)>);
  check(c, 2, usual, base, drive, motor, pull);
}

TEST_CASE("masses of coordinates") {
  STATIC_REQUIRE(by_articulated_bodies<decltype(rotors)>);
  check(rotors, 9, usual, base, drive, motor, pull);
  // The axis of the joint before: not singular.
  constexpr auto motors =
      chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(1.0, 1.0)), revolute_joint_2D(q2, k, l),
            inertia_2D(l, planar_body(1.0, 1.0)), inertia_gen(q2, 0.5));
  // M = (2, 1; 1, 1.5)
  const std::array none{0.0, 0.0}, one_of_them{1.0, 0.0};
  const joint_vector<double, 2> exact{0.75, -0.5};
  CHECK(gap(forward_dynamics(motors, none, none, one_of_them), exact) < 1e-15);
  const auto model = element_by_element(motors);
  auto s = model.make_state();
  CHECK(gap(forward_dynamics(model, s, none, none, one_of_them), exact) < 1e-15);
  CHECK(gap(forward_dynamics(model, s, none, none, one_of_them), exact) < 1e-15);  // whatever the state held before
}

}  // namespace articulated_given_test
