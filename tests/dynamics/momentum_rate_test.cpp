#include <kte/dynamics/momentum_rate.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// How the centre of mass and momentum change: a formula, differences at 50 digits, static against runtime.

using namespace kte;
using namespace kte::test;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 200 * eps;  // sums of what some bodies have, along at most 8 poses

template <class Chain>
void check(const Chain& c, unsigned seed) {
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const auto rate = eigen(centroidal_momentum_rate(c, m.q, m.v, m.a));
    const auto j = centre_of_mass_jacobian(c, m.q);
    const auto acceleration = eigen(centre_of_mass_acceleration(c, m.q, m.v, m.a));
    CHECK(gap(j * m.v, eigen(centre_of_mass_velocity(c, m.q, m.v))) < rounding);
    CHECK(gap(acceleration * centre_of_mass(c, m.q).mass, rate.template head<3>()) < rounding);
    // Central differences: h^2 f'''/6 of numbers below 1e3, and eps/h.
    const double h = 1e-5;
    const auto at = [&](double t) { return eigen(centroidal_momentum(c, position_at(c, m, t), velocity_at(m, t))); };
    CHECK(gap((at(h) - at(-h)) / (2 * h), rate) < 1e-7);
    CHECK(gap(centre_of_mass_jacobian(model, s, m.q), j) < rounding);
    CHECK(gap(eigen(centroidal_momentum_rate(model, s, m.q, m.v, m.a)), rate) < rounding);
    CHECK(gap(eigen(centroidal_momentum_rate(model, s)), rate) < rounding);
    CHECK(gap(eigen(centre_of_mass_acceleration(model, s, m.q, m.v, m.a)), acceleration) < rounding);
  }
}

}  // namespace

TEST_CASE("momentum rate of two masses on a turning rod, by its formula") {
  // 1 kg at 2 m and 3 kg at 0: c at 0.5 m, p' = m (-v^2, a) c, k_G' = (1 * 1.5^2 + 3 * 0.5^2) a.
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), inertia_2D(cart, point_mass(3.0)),
                           inertia_2D(cart, point_mass(1.0, vec3{2.0, 0.0, zero})))
                         .gravity(along_y(-9.81));
  const auto rate = centroidal_momentum_rate(c, std::array{0.0}, std::array{3.0}, std::array{5.0});
  CHECK(rate.linear.x == within(-4 * 9 * 0.5, 10 * eps));
  CHECK(rate.linear.y == within(4 * 5 * 0.5, 10 * eps));
  CHECK(rate.angular.z == within(3 * 5, 50 * eps));
  CHECK(centre_of_mass_acceleration(c, std::array{0.0}, std::array{3.0}, std::array{5.0}).x == within(-4.5, 10 * eps));
}

TEST_CASE("momentum rates by differences, static and runtime") {
  check(floating_with_springs, 1);
  check(planar, 2);
  check(geared, 3);
  check(models::tree, 4);
}

TEST_CASE("what falls freely keeps its momentum about its centre, and falls by g") {
  random_numbers random(5);
  const random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
  const auto a = forward_dynamics(floating, m.q, m.v, Eigen::Matrix<double, 11, 1>::Zero());
  const auto rate = centroidal_momentum_rate(floating, m.q, m.v, a);
  CHECK(gap(eigen(rate.angular), Eigen::Vector3d::Zero()) < 100 * rounding);  // of moments below 100 Nm
  CHECK(gap(eigen(centre_of_mass_acceleration(floating, m.q, m.v, a)), eigen(as<double>(weight))) < 10 * rounding);
}

TEST_CASE("momentum rates leave out bases and coordinates that are given") {
  const auto model = models::element_by_element(models::tree);
  auto s = model.make_state(), t = model.make_state();
  const std::array q{0.1, 0.2, 0.3}, v{1.0, 2.0, 3.0};
  s.frame_3D("ground").ang_velocity = {1, 2, 3}, s.coordinate("wall").q_dot = 5;
  CHECK(gap(eigen(centroidal_momentum_rate(model, s, q, v, v)), eigen(centroidal_momentum_rate(model, t, q, v, v))) ==
        0);
}

TEST_CASE("momentum rates of bad arguments") {
  const auto model = models::element_by_element(planar);
  auto s = model.make_state();
  const std::array<double, 4> q{0.1, 0.2, 0.3, 0.4}, nan{1, 2, std::numeric_limits<double>::quiet_NaN(), 4};
  CHECK_THROWS_AS(centroidal_momentum_rate(planar, q, q, nan), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum_rate(model, s, q, nan, q), bad_argument);
  CHECK_THROWS_AS(centre_of_mass_jacobian(model, s, nan), bad_argument);
  kte_map_chain none;
  none << revolute_joint_2D("q", "base", "end");
  auto t = none.make_state();
  CHECK_THROWS_AS(centre_of_mass_acceleration(none, t, std::array{0.0}, std::array{0.0}, std::array{0.0}),
                  bad_argument);
}
