#include <kte/dynamics/external_wrenches.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/elements/vmc_revolute_joint.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "dynamics/small_chains.hpp"

// Joints as controllers see them: that their torque overcomes the friction of the joint in earnest.

namespace vmc_revolute_joint_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// An arm with two such joints, or with dry joints; `joint` makes one from axis and radii.
template <class Joint>
constexpr auto arm_of(const Joint& joint) {
  return chain(joint(q1, ground, body, axis::y, 0.02, 0.03), inertia_3D(body, brick),
               joint(q2, body, hand, axis::x, 0.03, 0.05).at(vec3{0.3, 0.1, -0.2}, quarter_turn_y),
               inertia_3D(hand, stick))
      .gravity(weight);
}
/// So narrow that what is not yet sliding at rates of 0.1 is below rounding.
constexpr double narrow = 1e-10;
constexpr auto controller = arm_of([](const auto& q, const auto& b, const auto& e, const auto& n, double r, double r0) {
  return vmc_revolute_joint_3D(q, b, e, n, r, r0, narrow);
});
constexpr auto plant = arm_of([](const auto& q, const auto& b, const auto& e, const auto& n, double r, double) {
  return dry_revolute_joint_3D(q, b, e, n, r, narrow);
});

/// A mass of 2 kg on a bar of length r, horizontal, in the plane and in space: torque to lift it.
std::array<double, 2> to_lift(double r, double rate, double friction_radius, double stiction_radius) {
  const std::array<double, 1> q{0}, v{rate}, a{0};
  runtime_chain plane, space;
  plane << vmc_revolute_joint_2D("q", "base", "arm", friction_radius, stiction_radius, 1e-9)
        << inertia_2D("arm", point_mass(2.0, along_x(r)));
  space << vmc_revolute_joint_3D("q", "base", "arm", axis::z, friction_radius, stiction_radius, 1e-9)
        << inertia_3D("arm", point_mass(2.0, along_x(r)));
  plane.gravity(along_y(-10.0)), space.gravity(along_y(-10.0));
  auto s = plane.make_state();
  auto t = space.make_state();
  return {inverse_dynamics(plane, s, q, v, a)[0], inverse_dynamics(space, t, q, v, a)[0]};
}

TEST_CASE("what a controller joint asks for moves the joint in earnest as it should") {
  random_numbers random(3);
  const auto c = [] {
    runtime_chain r;
    r << controller;
    return r;
  }();
  auto s = c.make_state();
  for (int i = 0; i < 10; ++i) {
    Eigen::Vector2d q, v, a;
    for (int j = 0; j < 2; ++j) q[j] = 3 * random(), v[j] = random(), a[j] = 2 * random();
    for (int j = 0; j < 2; ++j) v[j] += v[j] < 0 ? -0.1 : 0.1;
    const Eigen::Vector2d tau = inverse_dynamics(controller, q, v, a);
    // The friction of some 1 N m; M^-1 is some 3 / (kg m^2), of a condition of some 10.
    CHECK((forward_dynamics(plant, q, v, tau) - a).norm() < 2e-13);
    CHECK((inverse_dynamics(c, s, q, v, a) - tau).norm() < 1e-14 * tau.norm());
  }
}

TEST_CASE("a controller joint breaks loose from rest") {
  // At rest: the load m g r, and what friction could hold, of at most the load.
  for (const double tau : to_lift(0.5, 0, 0.02, 0.03)) CHECK(tau == within(20 * 0.5 + 20 * 0.03, 4e-15));
  for (const double tau : to_lift(0.01, 0, 0.02, 0.03)) CHECK(tau == within(2 * 20 * 0.01, 1e-16));
  for (const double tau : to_lift(-0.5, 0, 0.02, 0.03)) CHECK(tau == within(-20 * 0.5 - 20 * 0.03, 4e-15));
  // Up: in addition to the load sliding friction; down the other way. The rate makes a force of m r v^2 along the bar.
  const double force = std::hypot(20.0, 2 * 0.5 * 0.01);
  for (const double tau : to_lift(0.5, 0.1, 0.02, 0.03)) CHECK(tau == within(20 * 0.5 + force * 0.02, 4e-15));
  for (const double tau : to_lift(0.5, -0.1, 0.02, 0.03)) CHECK(tau == within(20 * 0.5 - force * 0.02, 4e-15));
}

TEST_CASE("a controller joint is for passes and inverse dynamics") {
  runtime_chain c;
  c << controller;
  auto s = c.make_state();
  const Eigen::Vector2d x(0.1, 0.2);
  CHECK_THROWS_MATCHES(forward_dynamics(c, s, x, x, x), bad_argument, says("vmc_revolute_joint_3D"));
  CHECK_THROWS_MATCHES(vmc_revolute_joint_3D("q", "a", "b", axis::z, 0.02, 0.01), bad_parameter,
                       says("not below friction_radius"));
}

}  // namespace vmc_revolute_joint_test
