#include <limits>

#include "data/iiwa14.hpp"
#include "data/solo12.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"

// The parts of inverse dynamics: against 31 digits, against inverse dynamics, against energies.

namespace bias_forces_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// Sums of a few products along at most 8 frames: less than 100 roundings of the largest number, or of 1.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
/// At 50 digits.
constexpr double exact = 1e-45;

template <class S, class Chain>
auto zeros(const Chain&) {
  return joint_vector<S, Chain::dofs>(joint_vector<S, Chain::dofs>::Zero());
}
/// Gravity forces are the gradient of the potential energy of gravity, static forces of all potential energy.
template <class Chain>
void check_gradient(const Chain& c, unsigned seed, double tolerance = by_differences) {
  constexpr int n = Chain::dofs;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const auto q = random_configuration<big>(c, random);
    joint_vector<big, n> all, weight_alone;
    for (int j = 0; j < n; ++j) {
      const joint_vector<big, n> e = joint_vector<big, n>::Unit(j);
      all[j] = derivative([&](const big& t) { return potential_energy(c, integrate(c, q, e, t)); });
      weight_alone[j] = derivative([&](const big& t) {
        const auto m = centre_of_mass(c, integrate(c, q, e, t));
        return big(-m.mass * dot(as<big>(c.gravity()), m.position));
      });
    }
    CHECK(gap(static_forces(c, q), all) < tolerance);
    CHECK(gap(gravity_forces(c, q), weight_alone) < tolerance);
  }
}
/// v . (C v) is half of v . (dM/dt v), the derivative along v.
template <class Chain>
void check_power(const Chain& c, unsigned seed, double tolerance = by_differences) {
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion_of<big, Chain> m(c, random);
    const big half_change =
        derivative([&](const big& t) { return big(m.v.dot(mass_matrix(c, integrate(c, m.q, m.v, t)) * m.v) / 2); });
    const big power = m.v.dot(coriolis_forces(c, m.q, m.v));
    CHECK(static_cast<double>(abs(big(power - half_change)) / (1 + abs(half_change))) < tolerance);
  }
}
/// The sums by which the parts are defined.
template <class Chain>
void check_sums(const Chain& c, unsigned seed) {
  random_numbers random(seed);
  for (int round = 0; round < 5; ++round) {
    const random_motion_of<big, Chain> m(c, random);
    const auto none = zeros<big>(c);
    CHECK(gap(static_forces(c, m.q), inverse_dynamics(c, m.q, none, none)) < exact);
    CHECK(gap(nonlinear_effects(c, m.q, m.v), inverse_dynamics(c, m.q, m.v, none)) < exact);
    const auto light = c.gravity(zero3{});
    CHECK(gap(gravity_forces(light, m.q), none) < exact);
    CHECK(gap(coriolis_forces(light, m.q, m.v), coriolis_forces(c, m.q, m.v)) < exact);
    CHECK(gap(coriolis_forces(c, m.q, joint_vector<big, Chain::dofs>(3 * m.v)),
              (9 * coriolis_forces(c, m.q, m.v)).eval()) < exact);
  }
}
/// Static in double against 50 digits and against runtime.
template <class Chain>
void check_double(const Chain& c, unsigned seed) {
  random_numbers random(seed);
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const joint_vector<big, Chain::nq> q = m.q.template cast<big>();
    const joint_vector<big, Chain::dofs> v = m.v.template cast<big>();
    CHECK(gap(static_forces(c, m.q), static_forces(c, q)) < rounding);
    CHECK(gap(gravity_forces(c, m.q), gravity_forces(c, q)) < rounding);
    CHECK(gap(nonlinear_effects(c, m.q, m.v), nonlinear_effects(c, q, v)) < rounding);
    CHECK(gap(coriolis_forces(c, m.q, m.v), coriolis_forces(c, q, v)) < rounding);
    set_velocities(s, m.v), set_accelerations(s, m.a);
    CHECK(gap(static_forces(model, s, m.q), static_forces(c, m.q)) < rounding);
    CHECK(gap(gravity_forces(model, s, m.q), gravity_forces(c, m.q)) < rounding);
    CHECK(gap(nonlinear_effects(model, s, m.q, m.v), nonlinear_effects(c, m.q, m.v)) < rounding);
    CHECK(gap(coriolis_forces(model, s, m.q, m.v), coriolis_forces(c, m.q, m.v)) < rounding);
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
  check_gradient(robots::iiwa14, 1);
  check_gradient(floating, 2);
  check_gradient(floating_with_springs, 3);
  check_gradient(planar, 4);
  check_gradient(geared, 5);
  check_gradient(models::tree, 6, 1e-14);  // an axis that is a unit vector to half an eps
}

TEST_CASE("power of Coriolis forces") {
  check_power(robots::iiwa14, 11);
  check_power(floating_with_springs, 12);
  check_power(floating_with_dampers, 13);
  check_power(planar, 14);
  check_power(geared, 15);
  check_power(models::tree, 16, 1e-14);
}

TEST_CASE("parts of inverse dynamics") {
  check_sums(robots::iiwa14, 21);
  check_sums(floating_with_springs, 22);
  check_sums(floating_with_dampers, 23);
  check_sums(planar, 24);
  check_sums(models::tree, 25);
  // Forces of other elements do not count among those of gravity and Coriolis.
  random_numbers random(26);
  const random_motion_of<big, std::remove_const_t<decltype(floating)>> m(floating, random);
  CHECK(gravity_forces(floating, m.q) == gravity_forces(floating_with_springs, m.q));
  CHECK(coriolis_forces(floating, m.q, m.v) == coriolis_forces(floating_with_springs, m.q, m.v));
  CHECK(coriolis_forces(floating, m.q, m.v) == coriolis_forces(floating_with_dampers, m.q, m.v));
  CHECK(gap(static_forces(floating_with_dampers, m.q), gravity_forces(floating, m.q)) < exact);
  CHECK(gap((gravity_forces(floating, m.q) + coriolis_forces(floating, m.q, m.v)).eval(),
            nonlinear_effects(floating, m.q, m.v)) < exact);
}

TEST_CASE("parts of inverse dynamics in double, and of runtime chains") {
  check_double(robots::iiwa14, 31);
  check_double(floating, 32);
  check_double(floating_with_springs, 33);
  check_double(floating_with_dampers, 34);
  check_double(planar, 35);
  check_double(geared, 36);
  check_double(models::tree, 37);
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
