#include <kte/contract/coordinate_follower.hpp>
#include <kte/dynamics/coriolis_matrix.hpp>
#include <kte/dynamics/jacobian_rate.hpp>
#include <kte/dynamics/momentum.hpp>
#include <kte/math/dual.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "dynamics/square.hpp"
#include "static_models/static_model.hpp"

namespace coriolis_matrix_test {

// The Coriolis matrix: a formula, Christoffel's symbols, forces, the rate of the mass matrix; static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
/// Sums of products along at most 8 poses, twice.
constexpr double rounding = 200 * eps;

/// A coordinate that follows two: q_e = q_a + q_b sin q_a.
struct twice_led : coordinate_follower<twice_led> {
  static constexpr std::string_view type = "twice_led_gen";
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "a"}, {kind::gen, access::in, "b"}, {kind::gen, access::out, "end"}}};
  template <class A, class B>
  constexpr auto value(const A& a, const B& b) const {
    using std::sin;
    return a + b * sin(a);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

/// The functions under test of a static chain.
using function = Eigen::MatrixXd (*)(const Eigen::VectorXd& q, const Eigen::VectorXd& v);
template <const auto& Chain>
Eigen::MatrixXd coriolis(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return coriolis_matrix(Chain, q, v);
}
template <const auto& Chain>
Eigen::MatrixXd rate_of_momenta(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return generalized_momenta_along(Chain, q, v).second;
}
template <const auto& Chain>
Eigen::MatrixXd mass_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  return mass_matrix_rate(Chain, q, v);
}

/// `numbers`: whether v are the rates of q.
void check(const model& x, function coriolis, function mass_rate, function rate_of_momenta, bool numbers,
           unsigned seed) {
  const auto& c = x.in_double;
  auto s = x.runtime.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 5; ++round) {
    const random_motion<double> m(x.runtime, random);
    const auto matrix = coriolis(m.q, m.v), rate = mass_rate(m.q, m.v);
    CHECK(gap(matrix * m.v, c.coriolis_forces(m.q, m.v)) < rounding);
    CHECK(gap(rate, matrix + matrix.transpose()) == 0);
    // dM/dt v by dual numbers, and dM/dt by central differences.
    CHECK(gap(rate * m.v, rate_of_momenta(m.q, m.v)) < rounding);
    const double h = 1e-5;
    const auto mass_at = [&](double t) { return c.mass_matrix(c.integrate(m.q, m.v, t)); };
    CHECK(gap((mass_at(h) - mass_at(-h)) / (2 * h), rate) < 1e-7);  // h^2 f'''/6 of numbers below 1e3, and eps/h
    // C is bilinear: C(q, v) w = C(q, w) v, which Christoffel's symbols alone have, where v are rates of numbers.
    if (numbers) {
      const auto w = random_vector(c.dofs, 2, random);
      CHECK(gap(matrix * w, coriolis(m.q, w) * m.v) < rounding);
    }
    CHECK(gap(coriolis_matrix(x.runtime, s, m.q, m.v), matrix) < rounding);
    CHECK(gap(mass_matrix_rate(x.runtime, s, m.q, m.v), rate) < rounding);
    CHECK(gap(mass_matrix_rate(x.runtime, s), rate) < rounding);
  }
}
template <const auto& Chain>
void check(const model& x, unsigned seed) {
  using chain = std::remove_cvref_t<decltype(Chain)>;
  constexpr bool numbers = chain::nq == chain::dofs && chain::wiring::count(kind::pose_2D) == 0;
  check(x, coriolis<Chain>, mass_rate<Chain>, rate_of_momenta<Chain>, numbers, seed);
}

TEST_CASE("Coriolis matrix of two links, by its formula") {
  // m_2 at l_2 on a link of l_1: h = -m_2 l_1 l_2 sin q_2 and C = (h v_2, h (v_1 + v_2); -h v_1, 0).
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), rigid_link_2D(cart, rail, along_x(0.75)),
                           revolute_joint_2D(q2, rail, disc), inertia_2D(disc, point_mass(0.8, vec3{0.5, 0.0, zero})));
  const std::array q{0.3, 0.7}, v{1.5, -2.0};
  const double h = -0.8 * 0.75 * 0.5 * std::sin(q[1]);
  Eigen::Matrix2d expected;
  expected << h * v[1], h * (v[0] + v[1]), -h * v[0], 0;
  CHECK(gap(coriolis_matrix(c, q, v), expected) < 10 * eps);
}

TEST_CASE("Coriolis matrix by forces and the rate of the mass matrix, static and runtime") {
  check<floating_with_dampers>(static_models::floating_with_dampers(), 1);
  check<planar>(static_models::planar(), 2);
  check<geared>(static_models::geared(), 3);
  check<::models::tree>(static_models::tree(), 4);
}

TEST_CASE("Coriolis matrix where a ratio of coordinates changes") {
  constexpr auto c = chain(revolute_joint_3D(q1, ground, body, axis::x), inertia_3D(body, brick),
                           connect(square{}, q1, f1), inertia_gen(f1, 0.3), revolute_joint_3D(q2, body, aside, axis::z),
                           prismatic_joint_3D(f1, aside, hand, axis::y), inertia_3D(hand, stick));
  runtime_chain model;
  model << c;
  random_numbers random(5);
  const random_motion_of<double, std::remove_const_t<decltype(c)>> m(c, random);
  const auto matrix = coriolis_matrix(c, m.q, m.v);
  // The mass of a coordinate is not a body: its part of inverse dynamics is there for a = 0.
  CHECK(gap(matrix * m.v, inverse_dynamics(c, m.q, m.v, Eigen::Vector2d(0, 0))) < rounding);
  CHECK(gap((matrix + matrix.transpose()) * m.v, generalized_momenta_along(c, m.q, m.v).second) < rounding);
  auto s = model.make_state();
  CHECK(gap(coriolis_matrix(model, s, m.q, m.v), matrix) < rounding);
}

TEST_CASE("Coriolis matrix where a coordinate follows two others") {
  constexpr auto c =
      chain(revolute_joint_3D(q1, ground, body, axis::x), inertia_3D(body, brick),
            prismatic_joint_3D(q2, body, socket, axis::y), inertia_3D(socket, stick), connect(twice_led{}, q1, q2, f1),
            revolute_joint_3D(f1, socket, hand, axis::z), inertia_3D(hand, stick));
  runtime_chain model;
  model << c;
  auto s = model.make_state();
  random_numbers random(7);
  const random_motion_of<double, std::remove_const_t<decltype(c)>> m(c, random);
  const auto matrix = coriolis_matrix(c, m.q, m.v);
  CHECK(gap(matrix * m.v, inverse_dynamics(c, m.q, m.v, Eigen::Vector2d(0, 0))) < rounding);
  CHECK(gap((matrix + matrix.transpose()) * m.v, generalized_momenta_along(c, m.q, m.v).second) < rounding);
  CHECK(gap(coriolis_matrix(model, s, m.q, m.v), matrix) < rounding);
  // Jacobians, too, have its parts by both.
  CHECK(gap(jacobian(c, m.q, hand) * m.v, eigen(frame_velocity(c, m.q, m.v, hand))) < rounding);
  CHECK(gap(jacobian_rate(model, s, m.q, m.v, "hand"), jacobian_rate(c, m.q, m.v, hand)) < rounding);
}

TEST_CASE("Coriolis matrix where a coordinate is given") {
  // It rests where it is given by nobody: then the arm has one joint, and no Coriolis force.
  constexpr auto c = chain(base_gen(q1), revolute_joint_2D(q1, table, cart), rigid_link_2D(cart, rail, along_x(0.75)),
                           revolute_joint_2D(q2, rail, disc), inertia_2D(disc, point_mass(0.8, along_x(0.5))));
  const std::array q{0.7}, v{1.5};
  CHECK(coriolis_matrix(c, q, v)(0, 0) == 0);
  // With a rate in a state, by the formula of two links: C_22 = 0, and dM_22/dt = 2 C_22 = 0.
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  s.coordinate("q1").q_dot = 2;
  CHECK(coriolis_matrix(model, s, q, v)(0, 0) == within(0, 4 * eps));
}

TEST_CASE("Coriolis matrix far from the origin, and at more digits") {
  // 1e8 m away nothing changes: velocities and arms are relative.
  random_numbers random(6);
  random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
  const auto here = coriolis_matrix(floating, m.q, m.v);
  m.q[0] += 1e8;
  CHECK(gap(coriolis_matrix(floating, m.q, m.v), here) == 0);
  const random_motion_of<big, std::remove_const_t<decltype(planar)>> n(planar, random);
  const auto matrix = coriolis_matrix(planar, n.q, n.v);
  CHECK(gap(matrix * n.v, coriolis_forces(planar, n.q, n.v)) < 1e-47);
}

TEST_CASE("Coriolis matrix of bad arguments") {
  const auto model = models::element_by_element(planar);
  auto s = model.make_state();
  const std::array<double, 4> q{0.1, 0.2, 0.3, 0.4}, nan{1, 2, std::numeric_limits<double>::quiet_NaN(), 4};
  CHECK_THROWS_AS(coriolis_matrix(planar, q, nan), bad_argument);
  CHECK_THROWS_AS(coriolis_matrix(planar, nan, q), bad_argument);
  CHECK_THROWS_AS(coriolis_matrix(model, s, q, nan), bad_argument);
  CHECK_THROWS_AS(mass_matrix_rate(model, s, std::vector<double>(3), q), bad_argument);
  CHECK_THROWS_AS(mass_matrix_rate(planar, q, std::array{1e308, 1e308, 1e308, 1e308}), bad_argument);
}

}  // namespace coriolis_matrix_test
