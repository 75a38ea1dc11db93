#include <kte/dynamics/configurations.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/joint_reactions.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/dynamics/regressor.hpp>
#include <kte/dynamics/relative_motion.hpp>
#include <kte/dynamics/subtree_inertia.hpp>
#include <kte/elements/mimic.hpp>

#include "allocations.hpp"
#include "catch.hpp"
#include "chain/models.hpp"
#include "robots/iiwa14.hpp"

// No pass and no algorithm may touch the heap.

namespace allocation_test {

using allocations::during;

TEST_CASE("the counter counts") {
  CHECK(during([] { ::operator delete(::operator new(1)); }) == 1);
}

TEST_CASE("static chains allocate nothing") {
  const auto& c = robots::iiwa14;
  const std::array<double, 7> x{0.1, -0.2, 0.3, 0.4, -0.5, 0.6, 0.7};
  auto s = kte::make_state(c);
  CHECK(during([&] { s = kte::make_state(c); }) == 0);
  CHECK(during([&] { c.doMotion(s), c.clearForce(s), c.doForce(s); }) == 0);
  CHECK(during([&] { (void)kte::inverse_dynamics(c, x, x, x); }) == 0);
  CHECK(during([&] { (void)kte::inverse_dynamics(c, s); }) == 0);
  CHECK(during([&] { (void)kte::mass_matrix(c, x); }) == 0);
  CHECK(during([&] { (void)kte::mass_matrix(c, s); }) == 0);
  CHECK(during([&] { (void)kte::forward_dynamics(c, x, x, x); }) == 0);
  CHECK(during([&] { (void)kte::forward_dynamics(c, s); }) == 0);
  CHECK(during([&] { (void)kte::forward_kinematics(c, x, robots::iiwa14_names::tool); }) == 0);
  CHECK(during([&] { (void)kte::torque_regressor(c, x, x, x); }) == 0);
  CHECK(during([&] { (void)kte::inertial_parameters(c); }) == 0);
  const auto& tool = robots::iiwa14_names::tool;
  CHECK(during([&] { (void)kte::coriolis_matrix(c, x, x), (void)kte::mass_matrix_rate(c, x, x); }) == 0);
  CHECK(during([&] { (void)kte::jacobian_rate(c, x, x, tool), (void)kte::bias_acceleration(c, x, x, tool); }) == 0);
  CHECK(during([&] { (void)kte::relative_jacobian(c, x, tool, tool); }) == 0);
  CHECK(during([&] { (void)kte::relative_motion(c, x, x, x, tool, tool); }) == 0);
  CHECK(during([&] { (void)kte::joint_reaction(c, x, x, x, tool), (void)kte::subtree_inertia(c, x, tool); }) == 0);
  CHECK(during([&] { (void)kte::centroidal_momentum_rate(c, x, x, x); }) == 0);
  CHECK(during([&] { (void)kte::interpolate(c, x, x, 0.5), (void)kte::distance(c, x, x); }) == 0);
}

TEST_CASE("runtime chains allocate nothing once their state is made and has room for M") {
  // Also at sizes where Eigen's factorisation works by blocks.
  for (const int n : {7, 40, 150}) {
    kte::runtime_chain c;
    std::string frame = "base";
    for (int i = 0; i < n; ++i) {
      const auto k = std::to_string(i);
      c << kte::revolute_joint_3D("q" + k, frame, "a" + k,
                                  i % 2 == 0 ? kte::vec3{0.0, 0.0, 1.0} : kte::vec3{0.6, 0.8, 0.0})
        << kte::rigid_link_3D("a" + k, "b" + k, kte::along_x(0.3))
        << kte::inertia_3D("b" + k, kte::rigid_body{1.0, kte::vec3{0.1, 0.0, 0.0}, kte::diagonal(0.1, 0.1, 0.1)});
      frame = "b" + k;
    }
    auto s = c.make_state();
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 0.1, 0.9);
    (void)kte::mass_matrix(c, s, x);  // the first call reserves memory for M, the others find it
    CHECK(during([&] { c.doMotion(s), c.clearForce(s), c.doForce(s); }) == 0);
    CHECK(during([&] { (void)kte::inverse_dynamics(c, s, x, x, x); }) == 0);
    CHECK(during([&] { (void)kte::mass_matrix(c, s, x); }) == 0);
    CHECK(during([&] { (void)kte::forward_kinematics(c, s, frame); }) == 0);
    CHECK(during([&] { (void)kte::forward_dynamics(c, s, x, x, x); }) == 0);
    kte::runtime_jacobian j = kte::jacobian(c, s, x, frame);
    CHECK(during([&] { kte::jacobian(c, s, x, frame, j), kte::jacobian(c, s, frame, kte::in_world_axes, j); }) == 0);
  }
}

TEST_CASE("coordinates of several degrees of freedom and springs between frames allocate nothing") {
  using namespace kte;
  using models::ground, models::trunk, models::left, models::thigh, models::shank, models::hip, models::slide;
  static constexpr struct ball_ final : rotation_3D_key<"ball"> {
  } ball;
  static constexpr struct floating_ final : pose_3D_key<"floating"> {
  } floating;
  constexpr rigid_body body{1.5, vec3{0.02, -0.03, 0.1}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}};
  constexpr auto c =
      chain(revolute_joint_3D(hip, ground, left), inertia_3D(left, body), free_joint_3D(floating, left, trunk),
            inertia_3D(trunk, body), spherical_joint_3D(ball, trunk, thigh), inertia_3D(thigh, body),
            prismatic_joint_3D(slide, thigh, shank, axis::x), inertia_3D(shank, body),
            spring_3D(trunk, shank, 0.1, 20.0), damper_3D(shank, ground, 0.5));
  const auto q = neutral_configuration(c);
  const auto v = difference(c, q, q);
  auto s = make_state(c);
  CHECK(during([&] { (void)forward_dynamics(c, q, v, v); }) == 0);
  CHECK(during([&] { (void)forward_dynamics(c, s); }) == 0);
  CHECK(during([&] { (void)inverse_dynamics(c, q, v, v); }) == 0);
  CHECK(during([&] { (void)mass_matrix(c, q); }) == 0);

  // as a tree of joints, and with two joints that share a coordinate, in a cluster; the first call makes its memory
  auto model = models::element_by_element(c);
  for (const bool tree : {true, false}) {
    if (!tree) model << revolute_joint_3D("hip", "ground", "other", axis::y) << inertia_3D("other", body);
    auto r = model.make_state();
    (void)mass_matrix(model, r, q), (void)forward_dynamics(model, r, q, v, v);
    CHECK(during([&] { (void)forward_dynamics(model, r, q, v, v); }) == 0);
    CHECK(during([&] { (void)forward_dynamics(model, r); }) == 0);
    CHECK(during([&] { (void)inverse_dynamics(model, r, q, v, v); }) == 0);
    CHECK(during([&] { (void)mass_matrix(model, r, q); }) == 0);
  }
}

TEST_CASE("coordinates that follow one degree of freedom take no memory by their square") {
  using namespace kte;
  constexpr int n = 2000;
  runtime_chain c;
  std::string frame = "base";
  for (int i = 0; i < n; ++i) {
    const auto k = std::to_string(i);
    c << mimic_gen("q", "q" + k, i % 3 - 0.75) << revolute_joint_3D("q" + k, frame, "a" + k, axis::z)
      << rigid_link_3D("a" + k, "b" + k, along_x(0.01)) << inertia_3D("b" + k, point_mass(1.0));
    frame = "b" + k;
  }
  auto s = c.make_state();
  const std::array<double, 1> q{0.3}, none{}, one{1.0};
  double m = 0;
  // A matrix of all coordinates would take 8 n^2.
  CHECK(allocations::bytes_during([&] { m = mass_matrix(c, s, q)(0, 0); }) < 500 * n);
  CHECK(allocations::bytes_during([&] { (void)forward_dynamics(c, s, q, one, none); }) < 2500 * n);
  CHECK(during([&] { (void)mass_matrix(c, s, q), (void)forward_dynamics(c, s, q, one, none); }) == 0);
  const double at_rest = inverse_dynamics(c, s, q, none, none)[0];
  const double expected = inverse_dynamics(c, s, q, none, one)[0] - at_rest;
  CHECK(m == within_relative(expected, n * 1e-16));
}

}  // namespace allocation_test
