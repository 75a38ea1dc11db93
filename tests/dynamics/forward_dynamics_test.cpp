#include "catch.hpp"
#include "chain/models.hpp"
#include "dynamics/double_error.hpp"
#include "dynamics/small_chains.hpp"
#include "eigenvalues.hpp"
#include "robots/iiwa14.hpp"

// Forward dynamics after inverse dynamics, of mechanisms with a formula, at 50 digits. More: reference_test.cpp,
// serial_chains_test.cpp, articulated_*_test.cpp.

namespace forward_dynamics_test {

using namespace kte;
using models::base, models::pendulum;
using test::small_chains::random_vector;

// clang-format off
inline constexpr struct q1_    final : coord_key<"q1">       {} q1;
inline constexpr struct q2_    final : coord_key<"q2">       {} q2;
inline constexpr struct arm1_  final : frame_2D_key<"arm1">  {} arm1;
inline constexpr struct arm2_  final : frame_2D_key<"arm2">  {} arm2;
inline constexpr struct end1_  final : frame_2D_key<"end1">  {} end1;
inline constexpr struct end2_  final : frame_2D_key<"end2">  {} end2;
inline constexpr struct wall_  final : coord_key<"wall">     {} wall;
inline constexpr struct motor_ final : input_key<"motor">    {} motor;
// clang-format on

template <class Chain>
void check_after_inverse_dynamics(const Chain& c, unsigned seed) {
  constexpr int n = Chain::dofs;
  using V = joint_vector<double, n>;
  random_numbers random(seed);
  for (int round = 0; round < 200; ++round) {
    const V q = random_vector<double, n>(random, 3), v = random_vector<double, n>(random, 2),
            a = random_vector<double, n>(random, 5);
    const V tau = inverse_dynamics(c, q, v, a);
    const V again = forward_dynamics(c, q, v, tau);
    // A solve loses the condition of M at most.
    const Eigen::VectorXd eigenvalues = test::eigenvalues_of(mass_matrix(c, q));
    const double condition = eigenvalues[n - 1] / eigenvalues[0];
    CHECK((again - a).norm() < 20 * 2.2e-16 * condition * std::max(a.norm(), tau.norm() / eigenvalues[n - 1]));
  }
}

TEST_CASE("forward dynamics after inverse dynamics") {
  check_after_inverse_dynamics(pendulum, 1);
  check_after_inverse_dynamics(models::tree, 2);
  check_after_inverse_dynamics(robots::iiwa14, 3);
}

TEST_CASE("forward dynamics of a double pendulum") {
  constexpr double m1 = 1.3, m2 = 0.7, l1 = 0.9, l2 = 1.2, g = 9.81;
  constexpr auto c =
      chain(revolute_joint_2D(q1, base, arm1), rigid_link_2D(arm1, end1, along_x(l1)), inertia_2D(end1, point_mass(m1)),
            revolute_joint_2D(q2, end1, arm2), rigid_link_2D(arm2, end2, along_x(l2)), inertia_2D(end2, point_mass(m2)))
          .gravity(along_y(-g));
  random_numbers random(1);
  for (int round = 0; round < 100; ++round) {
    const double a = random(3), b = random(3), u = random(4), w = random(4);  // angles and rates, the second relative
    const double t1 = random(5), t2 = random(5);
    // Lagrange: M = [m1 l1^2 + m2 (l1^2 + l2^2 + 2 l1 l2 cos b), m2 (l2^2 + l1 l2 cos b); ., m2 l2^2]
    const double m12 = m2 * (l2 * l2 + l1 * l2 * std::cos(b)), m22 = m2 * l2 * l2;
    const double m11 = m1 * l1 * l1 + m2 * (l1 * l1 + l2 * l2 + 2 * l1 * l2 * std::cos(b));
    const double h = m2 * l1 * l2 * std::sin(b);
    const double b1 = -h * (2 * u * w + w * w) + (m1 + m2) * g * l1 * std::cos(a) + m2 * g * l2 * std::cos(a + b);
    const double b2 = h * u * u + m2 * g * l2 * std::cos(a + b);
    const double det = m11 * m22 - m12 * m12;
    const double exact1 = (m22 * (t1 - b1) - m12 * (t2 - b2)) / det, exact2 = (m11 * (t2 - b2) - m12 * (t1 - b1)) / det;
    const auto x = forward_dynamics(c, std::array{a, b}, std::array{u, w}, std::array{t1, t2});
    // About 30 roundings of numbers up to 100, divided by det >= 0.5: 30 eps 100 / 0.5 is 1.3e-12.
    CHECK(x[0] == within(exact1, 1.3e-12));
    CHECK(x[1] == within(exact2, 1.3e-12));
  }
}

TEST_CASE("forward dynamics of masses and springs in a row") {
  constexpr auto c = chain(base_gen(wall), inertia_gen(q1, 2.0), inertia_gen(q2, 3.0), spring_gen(wall, q1, 1.0, 10.0),
                           spring_gen(q1, q2, 1.0, 20.0), damper_gen(q1, q2, 0.5), driving_actuator_gen(q2, motor));
  STATIC_REQUIRE(decltype(c)::dofs == 2);
  const auto x = forward_dynamics(c, std::array{1.5, 2.0}, std::array{1.0, 3.0}, std::array{0.0, 0.0});
  // Forces are exact; a product with the rounded inverse of the mass, and the division here: 3 eps / 2 = 3.3e-16.
  CHECK(x[0] == within_relative((-10 * 0.5 + 20 * (0.5 - 1) + 0.5 * 2) / 2, 4e-16));
  CHECK(x[1] == within_relative((-20 * (0.5 - 1) - 0.5 * 2) / 3, 4e-16));
  auto s = make_state(c);  // with a moved wall and a motor
  s[q1].q = 1.5, s[q2].q = 2.0, s[wall].q = 0.25, s[motor] = 6.0;
  const auto y = forward_dynamics(c, s);
  CHECK(y[0] == within_relative((-10 * 0.25 + 20 * (0.5 - 1)) / 2, 4e-16));
  CHECK(y[1] == within_relative((-20 * (0.5 - 1) + 6) / 3, 4e-16));
}

TEST_CASE("forward dynamics on a base that moves") {
  // In an accelerated, turning base a body at rest in it needs a force of m (a + al x r + w x (w x r)).
  constexpr auto c = chain(prismatic_joint_2D(q1, base, arm1, axis::x), inertia_2D(arm1, point_mass(2.0)));
  auto s = make_state(c);
  s[base].acceleration = {1.0, 5.0};
  s[base].ang_velocity = 3.0;
  s[base].ang_acceleration = 7.0;
  s[q1].q = 0.5;
  CHECK(forward_dynamics(c, s)[0] == -(1.0 - 9.0 * 0.5));
}

TEST_CASE("forward dynamics of static and runtime chains agree") {
  const auto model = models::element_by_element(models::tree);
  auto s = model.make_state();
  random_numbers random(4);
  for (int round = 0; round < 100; ++round) {
    const auto q = random_vector<double, 3>(random, 3), v = random_vector<double, 3>(random, 2),
               x = random_vector<double, 3>(random, 9);
    const auto a = forward_dynamics(models::tree, q, v, x);
    CHECK((a - forward_dynamics(model, s, q, v, x)).norm() < 1e-13 * a.norm());  // condition of M: 200
  }
}

TEST_CASE("forward dynamics in double precision against 50 digits") {
  random_numbers random(6);
  for (int round = 0; round < 20; ++round) {
    const auto q = random_vector<double, 7>(random, 3), v = random_vector<double, 7>(random, 2),
               x = random_vector<double, 7>(random, 5);
    const auto exact =
        forward_dynamics(robots::iiwa14, test::at_50_digits(q), test::at_50_digits(v), test::at_50_digits(x));
    CHECK(test::error_of_double(forward_dynamics(robots::iiwa14, q, v, x), exact) < 1e-13);  // any state
  }
}

}  // namespace forward_dynamics_test
