#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/momentum_rate.hpp>
#include <kte/kte.hpp>

#include <limits>

#include "catch.hpp"
#include "chain/registered.hpp"

// Loads from outside: what is refused is refused before the state is touched. (What they do:
// elements/actuators_test.cpp.)

namespace external_wrenches_test {

using namespace kte;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

runtime_chain arm(double length = 1) {
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "arm", axis::y) << rigid_link_3D("arm", "tip", vec3{length, 0.0, 0.0})
    << inertia_3D("tip", point_mass(1.0));
  return c.gravity(along_z(-9.81));
}

TEST_CASE("a call with loads that throws leaves the state unchanged") {
  const auto c = arm();
  auto s = c.make_state();
  set_positions(s, std::array{0.25}), set_velocities(s, std::array{-0.5}), set_accelerations(s, std::array{2.0});
  const std::array q{1.0}, v{0.5}, x{3.0}, none{not_a_number};
  const std::vector<external_wrench> load{{"tip", {0, 0, -5}}}, late{{"tip", {0, 0, -5}}, {"nope"}},
      non_finite{{"tip", {0, 0, -5}}, {"tip", {0, not_a_number, 0}}};
  const auto refused = [&](const auto& call) {
    CHECK_THROWS_AS(call(), bad_argument);
    CHECK((s.coordinate("q").q == 0.25 && s.coordinate("q").q_dot == -0.5 && s.coordinate("q").q_ddot == 2.0));
  };
  refused([&] { return external_forces(c, s, none, load); });
  refused([&] { return external_forces(c, s, q, non_finite); });
  CHECK_THROWS_AS(external_forces(c, s, q, late), unknown_name);
  for (const auto& bad : {std::vector{not_a_number}, std::vector{1.0, 2.0}}) {
    refused([&] { return inverse_dynamics(c, s, q, bad, x, load); });
    refused([&] { return inverse_dynamics(c, s, q, v, bad, load); });
    refused([&] { return forward_dynamics(c, s, q, bad, x, load); });
    refused([&] { return forward_dynamics(c, s, q, v, bad, load); });
  }
  refused([&] { return inverse_dynamics(c, s, q, v, x, non_finite); });
  CHECK_THROWS_AS(inverse_dynamics(c, s, q, v, x, late), unknown_name);
  CHECK(s.coordinate("q").q == 0.25);
  CHECK_THROWS_AS(forward_dynamics(c, s, q, v, x, late), unknown_name);
  CHECK(s.coordinate("q").q == 0.25);
  // m l^2 a - m g l cos q - 5 l: the load turns with the arm; and back
  const double tau = inverse_dynamics(c, s, q, v, x, load)[0];
  CHECK(tau == within(3.0 - 9.81 * std::cos(1.0) - 5, 1e-14));
  CHECK(forward_dynamics(c, s, q, v, std::array{tau}, load)[0] == within(3.0, 1e-14));
  // vectors with typed zeros, as static chains take them
  CHECK(inverse_dynamics(c, s, q, v, x, {{"tip", along_z(-5.0)}})[0] == tau);
  CHECK(external_forces(c, s, q, {{"tip", {}, along_y(2.0)}, {"tip", along_z(-5)}})[0] == within(7, 1e-14));
}

TEST_CASE("loads whose moment is not finite") {
  const auto c = arm();
  auto s = c.make_state();
  const std::array q{0.0};
  const external_wrench large{"tip", {0, 0, 1.7e308}};
  CHECK_THROWS_AS(external_forces(c, s, q, {large, large}), bad_argument);
  CHECK_THROWS_WITH(external_forces(c, s, q, {{"tip", {0, 0, HUGE_VAL}}}),
                    "kte: an external force or torque on 'tip' is not finite");
  const auto long_arm = arm(1e155);
  auto t = long_arm.make_state();
  CHECK_THROWS_AS(external_forces(long_arm, t, q, {{"tip", {0, 0, 1e200}}}), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum_matrix(long_arm, t, q), bad_argument);
  CHECK(centre_of_mass_jacobian(long_arm, t, q).cwiseAbs().maxCoeff() == 1e155);  // needs no moment
}

}  // namespace external_wrenches_test
