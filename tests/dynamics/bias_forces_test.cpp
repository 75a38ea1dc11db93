#include <limits>

#include "data/iiwa14.hpp"
#include "data/solo12.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"
#include "static_models/static_model.hpp"

namespace bias_forces_test {

// The parts of inverse dynamics: against 31 digits, against inverse dynamics, against energies.

using namespace kte;
using namespace kte::test;
using small_chains::big, small_chains::by_differences, small_chains::derivative, small_chains::gap, small_chains::off;
using big_vector = static_model<big>::vector;

/// Sums of a few products along at most 8 frames: less than 100 roundings of the largest number, or of 1.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
/// At 50 digits.
constexpr double exact = 1e-45;

/// Gravity forces are the gradient of the potential energy of gravity, static forces of all potential energy.
void check_gradient(const model& x, unsigned seed, double tolerance = by_differences) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const auto q = random_configuration<big>(x.runtime, random);
    big_vector all(c.dofs), weight_alone(c.dofs);
    for (int j = 0; j < c.dofs; ++j) {
      const big_vector e = big_vector::Unit(c.dofs, j);
      all[j] = derivative([&](const big& t) { return c.potential_energy(c.integrate(q, e, t)); });
      weight_alone[j] = derivative([&](const big& t) {
        const auto m = c.centre_of_mass(c.integrate(q, e, t));
        return big(-m.mass * dot(as<big>(c.gravity), m.position));
      });
    }
    CHECK(gap(c.static_forces(q), all) < tolerance);
    CHECK(gap(c.gravity_forces(q), weight_alone) < tolerance);
  }
}
/// v . (C v) is half of v . (dM/dt v), the derivative along v.
void check_power(const model& x, unsigned seed, double tolerance = by_differences) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<big> m(x.runtime, random);
    const big half_change =
        derivative([&](const big& t) { return big(m.v.dot(c.mass_matrix(c.integrate(m.q, m.v, t)) * m.v) / 2); });
    const big power = m.v.dot(c.coriolis_forces(m.q, m.v));
    CHECK(static_cast<double>(abs(big(power - half_change)) / (1 + abs(half_change))) < tolerance);
  }
}
/// The sums by which the parts are defined.
void check_sums(const model& x, unsigned seed) {
  const auto& c = x.exact;
  const big_vector none = big_vector::Zero(c.dofs);
  random_numbers random(seed);
  for (int round = 0; round < 5; ++round) {
    const random_motion<big> m(x.runtime, random);
    CHECK(gap(c.static_forces(m.q), c.inverse_dynamics(m.q, none, none)) < exact);
    CHECK(gap(c.nonlinear_effects(m.q, m.v), c.inverse_dynamics(m.q, m.v, none)) < exact);
    CHECK(gap(c.gravity_forces_without_gravity(m.q), none) < exact);
    CHECK(gap(c.coriolis_forces_without_gravity(m.q, m.v), c.coriolis_forces(m.q, m.v)) < exact);
    CHECK(gap(c.coriolis_forces(m.q, 3 * m.v), big_vector(9 * c.coriolis_forces(m.q, m.v))) < exact);
  }
}
/// Static in double against 50 digits and against runtime.
void check_double(const model& x, unsigned seed) {
  const auto& c = x.in_double;
  random_numbers random(seed);
  auto s = x.runtime.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion<double> m(x.runtime, random);
    const big_vector q = m.q.cast<big>(), v = m.v.cast<big>();
    CHECK(gap(c.static_forces(m.q), x.exact.static_forces(q)) < rounding);
    CHECK(gap(c.gravity_forces(m.q), x.exact.gravity_forces(q)) < rounding);
    CHECK(gap(c.nonlinear_effects(m.q, m.v), x.exact.nonlinear_effects(q, v)) < rounding);
    CHECK(gap(c.coriolis_forces(m.q, m.v), x.exact.coriolis_forces(q, v)) < rounding);
    set_velocities(s, m.v), set_accelerations(s, m.a);
    CHECK(gap(static_forces(x.runtime, s, m.q), c.static_forces(m.q)) < rounding);
    CHECK(gap(gravity_forces(x.runtime, s, m.q), c.gravity_forces(m.q)) < rounding);
    CHECK(gap(nonlinear_effects(x.runtime, s, m.q, m.v), c.nonlinear_effects(m.q, m.v)) < rounding);
    CHECK(gap(coriolis_forces(x.runtime, s, m.q, m.v), c.coriolis_forces(m.q, m.v)) < rounding);
    CHECK(velocities(s) == m.v);  // the state keeps its rates
    CHECK(accelerations(s) == m.a);
  }
}

TEST_CASE("bias against 31 digits") {
  // As inverse dynamics (reference_test.cpp, floating_base_test.cpp).
  for (const auto& x : reference::iiwa14) CHECK(off(nonlinear_effects(robots::iiwa14, x.q, x.v), x.bias, 7) < 1e-15L);
  for (const auto& x : reference::solo12) CHECK(off(nonlinear_effects(robots::solo12, x.q, x.v), x.bias, 18) < 1e-15L);
}

TEST_CASE("gravity and springs are gradients of energies") {
  check_gradient(static_models::iiwa14(), 1);
  check_gradient(static_models::floating(), 2);
  check_gradient(static_models::floating_with_springs(), 3);
  check_gradient(static_models::planar(), 4);
  check_gradient(static_models::geared(), 5);
  check_gradient(static_models::tree(), 6, 1e-14);  // an axis that is a unit vector to half an eps
}

TEST_CASE("power of Coriolis forces") {
  check_power(static_models::iiwa14(), 11);
  check_power(static_models::floating_with_springs(), 12);
  check_power(static_models::floating_with_dampers(), 13);
  check_power(static_models::planar(), 14);
  check_power(static_models::geared(), 15);
  check_power(static_models::tree(), 16, 1e-14);
}

TEST_CASE("parts of inverse dynamics") {
  check_sums(static_models::iiwa14(), 21);
  check_sums(static_models::floating_with_springs(), 22);
  check_sums(static_models::floating_with_dampers(), 23);
  check_sums(static_models::planar(), 24);
  check_sums(static_models::tree(), 25);
  // Forces of other elements do not count among those of gravity and Coriolis.
  random_numbers random(26);
  const random_motion<big> m(static_models::floating().runtime, random);
  const auto &floating = static_models::floating().exact, &springs = static_models::floating_with_springs().exact,
             &dampers = static_models::floating_with_dampers().exact;
  CHECK(floating.gravity_forces(m.q) == springs.gravity_forces(m.q));
  CHECK(floating.coriolis_forces(m.q, m.v) == springs.coriolis_forces(m.q, m.v));
  CHECK(floating.coriolis_forces(m.q, m.v) == dampers.coriolis_forces(m.q, m.v));
  CHECK(gap(dampers.static_forces(m.q), floating.gravity_forces(m.q)) < exact);
  CHECK(gap(big_vector(floating.gravity_forces(m.q) + floating.coriolis_forces(m.q, m.v)),
            floating.nonlinear_effects(m.q, m.v)) < exact);
}

TEST_CASE("parts of inverse dynamics in double, and of runtime chains") {
  check_double(static_models::iiwa14(), 31);
  check_double(static_models::floating(), 32);
  check_double(static_models::floating_with_springs(), 33);
  check_double(static_models::floating_with_dampers(), 34);
  check_double(static_models::planar(), 35);
  check_double(static_models::geared(), 36);
  check_double(static_models::tree(), 37);
}

TEST_CASE("forces of gravity on a base that turns, or not, are inverse dynamics at rest") {
  const auto c = models::element_by_element(robots::iiwa14);
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(7, -1.0, 1.4), rest = Eigen::VectorXd::Zero(7);
  for (const double spin : {0.0, 2.0}) {
    auto& base = s.frame_3D("base");
    base.acceleration.x = 3.0, base.ang_velocity.y = spin, base.ang_acceleration.x = -spin;
    const Eigen::VectorXd expected = inverse_dynamics(c, s, q, rest, rest);
    CHECK((gravity_forces(c, s, q) - expected).norm() <= 1e-15 * expected.norm());
  }
}

TEST_CASE("parts of inverse dynamics for bad arguments") {
  const auto& c = robots::iiwa14;
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const std::vector two{1.0, 2.0};
  CHECK_THROWS_AS(gravity_forces(c, two), bad_argument);
  CHECK_THROWS_AS(static_forces(c, two), bad_argument);
  CHECK_THROWS_AS(nonlinear_effects(c, good, two), bad_argument);
  CHECK_THROWS_AS(coriolis_forces(c, good, two), bad_argument);
  CHECK_THROWS_AS(coriolis_forces(model, s, good, two), bad_argument);
  for (std::size_t i = 0; i < 7; ++i) {
    auto bad = good;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(gravity_forces(c, bad), bad_argument);
    CHECK_THROWS_AS(static_forces(c, bad), bad_argument);
    CHECK_THROWS_AS(nonlinear_effects(c, bad, good), bad_argument);
    CHECK_THROWS_AS(nonlinear_effects(c, good, bad), bad_argument);
    CHECK_THROWS_AS(coriolis_forces(c, bad, good), bad_argument);
    CHECK_THROWS_AS(coriolis_forces(c, good, bad), bad_argument);
    CHECK_THROWS_AS(gravity_forces(model, s, bad), bad_argument);
    CHECK_THROWS_AS(static_forces(model, s, bad), bad_argument);
    CHECK_THROWS_AS(nonlinear_effects(model, s, good, bad), bad_argument);
    CHECK_THROWS_AS(coriolis_forces(model, s, good, bad), bad_argument);
  }
}

}  // namespace bias_forces_test
