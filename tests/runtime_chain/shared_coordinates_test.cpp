#include <kte/kte.hpp>

#include "catch.hpp"

namespace shared_coordinates_test {
using namespace kte;
using kte::test::within;

constexpr rigid_body body{1.5, vec3{0.1, -0.2, 0.25}, sym3{0.2, 0.01, -0.02, 0.25, 0.03, 0.3}};

runtime_chain two_joints_with_one_coordinate() {
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("q", "base", "a", axis::y) << inertia_3D("a", body)
                            << rigid_link_3D("a", "b", vec3{0.1, 0.2, 0.3}) << revolute_joint_3D("q", "b", "c", axis::x)
                            << inertia_3D("c", body);
  return c;
}

TEST_CASE("a coordinate that moves two joints is accelerated by the sum of their masses") {
  const auto c = two_joints_with_one_coordinate();
  auto s = c.make_state();
  const std::array q{0.3}, v{-0.7}, tau{2.0}, at_rest{0.0};
  const double bias = inverse_dynamics(c, s, q, v, at_rest)[0], mass = mass_matrix(c, s, q)(0, 0);
  CHECK(forward_dynamics(c, s, q, v, tau)[0] == within((tau[0] - bias) / mass, 1e-14));
}

}  // namespace shared_coordinates_test
