#include "catch.hpp"
#include "chain/models.hpp"
#include "dynamics/double_error.hpp"
#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"

// Inverse dynamics by powers, on a base that moves, at 50 digits; forward kinematics beside it. More:
// reference_test.cpp, serial_chains_test.cpp.

namespace inverse_dynamics_test {

using namespace kte;
using models::base, models::hand;
using test::small_chains::big, test::small_chains::random_vector;

// clang-format off
inline constexpr struct slide_ final : coord_key<"slide">  {} slide;
inline constexpr struct cart_  final : frame_2D_key<"cart"> {} cart;
// clang-format on

/// v . (tau - tau at rest) = damping + d/dt (v M v / 2): all velocity terms in one equation. Returns the relative gap.
/// Central differences with h = 1e-12 err by h^2 = 1e-24, and lose 1e-50/h = 1e-38.
template <class Chain, class Damping>
double power_gap(const Chain& c, random_numbers& random, const Damping& damping) {
  constexpr int n = Chain::dofs;
  using V = joint_vector<big, n>;
  const V q = random_vector<big, n>(random, 3), v = random_vector<big, n>(random, 2),
          a = random_vector<big, n>(random, 5);
  const V zeros = V::Zero();
  const auto kinetic = [&](const big& t) {
    const V qt = q + v * t + a * (t * t / 2), vt = v + a * t;
    return big(vt.dot(mass_matrix(c, qt) * vt) / 2);
  };
  const big h = 1e-12;
  const big change = (kinetic(h) - kinetic(-h)) / (2 * h);
  const V work = inverse_dynamics(c, q, v, a) - inverse_dynamics(c, q, zeros, zeros);
  return static_cast<double>(abs(v.dot(work) - damping(v) - change) / (1 + abs(change)));
}

TEST_CASE("inverse dynamics at 50 digits does work that changes the kinetic energy") {
  random_numbers random(5);
  for (int round = 0; round < 5; ++round) {
    CHECK(power_gap(robots::iiwa14, random, [](const auto&) { return big(0); }) < 1e-21);
    // The axis (0.6, 0, 0.8) of the tree is a unit vector to half an eps only.
    CHECK(power_gap(models::tree, random, [](const auto& v) { return big(0.8 * (v[0] - v[2]) * (v[0] - v[2])); }) <
          1e-15);
  }
}

TEST_CASE("inverse dynamics and forward kinematics on a base that moves") {
  // In an accelerated, turning base a body at rest in it needs a force of m (a + al x r + w x (w x r)).
  constexpr auto c = chain(prismatic_joint_2D(slide, base, cart, axis::x), inertia_2D(cart, point_mass(2.0)));
  auto s = make_state(c);
  s[base].acceleration = {1.0, 5.0};
  s[base].ang_velocity = 3.0;
  s[base].ang_acceleration = 7.0;
  s[slide].q = 0.5;
  CHECK(inverse_dynamics(c, s)[0] == 2 * (1.0 - 9.0 * 0.5));
  s[base].position = {10.0, 20.0};
  s[base].rotation = rotation_by(0.5);
  const auto p = forward_kinematics(c, s, cart);
  CHECK(p.position.x == within(10 + 0.5 * std::cos(0.5), 2e-15));
  CHECK(p.position.y == within(20 + 0.5 * std::sin(0.5), 4e-15));  // half an ulp on either side
}

TEST_CASE("inverse dynamics and forward kinematics of static and runtime chains agree") {
  const auto model = models::element_by_element(models::tree);
  auto s = model.make_state();
  random_numbers random(4);
  for (int round = 0; round < 100; ++round) {
    const auto q = random_vector<double, 3>(random, 3), v = random_vector<double, 3>(random, 2),
               a = random_vector<double, 3>(random, 9);
    const auto tau = inverse_dynamics(models::tree, q, v, a);
    CHECK((tau - inverse_dynamics(model, s, q, v, a)).norm() <= 20 * 2.2e-16 * (1 + tau.norm()));
    const auto p = forward_kinematics(models::tree, q, hand), r = forward_kinematics(model, s, q, "hand");
    CHECK((to_eigen(p.position) - to_eigen(r.position)).norm() < 1e-15);
  }
}

TEST_CASE("inverse dynamics in double precision against 50 digits") {
  random_numbers random(6);
  for (int round = 0; round < 20; ++round) {
    const auto q = random_vector<double, 7>(random, 3), v = random_vector<double, 7>(random, 2),
               a = random_vector<double, 7>(random, 5);
    const auto exact =
        inverse_dynamics(robots::iiwa14, test::at_50_digits(q), test::at_50_digits(v), test::at_50_digits(a));
    CHECK(test::error_of_double(inverse_dynamics(robots::iiwa14, q, v, a), exact) < 1e-15);
  }
}

}  // namespace inverse_dynamics_test
