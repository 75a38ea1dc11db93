#include <kte/dynamics/momentum_rate.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace momentum_rate_test {

// How the centre of mass and momentum change: a formula, differences at 50 digits, static against runtime.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 200 * eps;  // sums of what some bodies have, along at most 8 poses

/// The functions under test of a static chain.
struct functions {
  using vector = Eigen::VectorXd;
  Eigen::MatrixXd (*jacobian)(const vector& q);
  vector (*momentum_rate)(const vector& q, const vector& v, const vector& a);
  vector (*acceleration)(const vector& q, const vector& v, const vector& a);
};
template <const auto& Chain>
constexpr functions functions_of{[](const auto& q) -> Eigen::MatrixXd { return centre_of_mass_jacobian(Chain, q); },
                                 [](const auto& q, const auto& v, const auto& a) -> Eigen::VectorXd {
                                   return eigen(centroidal_momentum_rate(Chain, q, v, a));
                                 },
                                 [](const auto& q, const auto& v, const auto& a) -> Eigen::VectorXd {
                                   return eigen(centre_of_mass_acceleration(Chain, q, v, a));
                                 }};

void check(const model& x, const functions& f, unsigned seed) {
  const auto& c = x.in_double;
  auto s = x.runtime.make_state();
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<double> m(x.runtime, random);
    const auto rate = f.momentum_rate(m.q, m.v, m.a), acceleration = f.acceleration(m.q, m.v, m.a);
    const auto j = f.jacobian(m.q);
    CHECK(gap(j * m.v, c.centre_of_mass_velocity(m.q, m.v)) < rounding);
    CHECK(gap(acceleration * c.centre_of_mass(m.q).mass, rate.head<3>()) < rounding);
    // Central differences: h^2 f'''/6 of numbers below 1e3, and eps/h.
    const double h = 1e-5;
    const auto at = [&](double t) { return c.centroidal_momentum(m.position_at(c, t), m.velocity_at(t)); };
    CHECK(gap((at(h) - at(-h)) / (2 * h), rate) < 1e-7);
    CHECK(gap(centre_of_mass_jacobian(x.runtime, s, m.q), j) < rounding);
    CHECK(gap(eigen(centroidal_momentum_rate(x.runtime, s, m.q, m.v, m.a)), rate) < rounding);
    CHECK(gap(eigen(centroidal_momentum_rate(x.runtime, s)), rate) < rounding);
    CHECK(gap(eigen(centre_of_mass_acceleration(x.runtime, s, m.q, m.v, m.a)), acceleration) < rounding);
  }
}

TEST_CASE("momentum rate of two masses on a turning rod, by its formula", "[laws]") {
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
  check(static_models::floating_with_springs(), functions_of<floating_with_springs>, 1);
  check(static_models::planar(), functions_of<planar>, 2);
  check(static_models::geared(), functions_of<geared>, 3);
  check(static_models::tree(), functions_of<::models::tree>, 4);
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
  runtime_chain none;
  none << revolute_joint_2D("q", "base", "end");
  auto t = none.make_state();
  CHECK_THROWS_AS(centre_of_mass_acceleration(none, t, std::array{0.0}, std::array{0.0}, std::array{0.0}),
                  bad_argument);
}

TEST_CASE("bases that signals move have momentum, as coordinates that they move") {
  // A table that is moved and turned, with a mass on it and an arm: as a frame, and as a slide and a hinge at given
  // positions.
  const auto with = [](const auto&... table) {
    runtime_chain c;
    (c << ... << table);
    c << inertia_3D("top", point_mass(0.75, vec3{0.1, -0.2, 0.3})) << revolute_joint_3D("q", "top", "arm", axis::x)
      << inertia_3D("arm", rigid_body{1.5, vec3{0.02, -0.03, 0.5}, sym3{0.03, 0.001, -0.002, 0.025, 0.003, 0.02}});
    return c.gravity(vec3{0.3, -0.4, -9.81});
  };
  const auto frames =
      with(position_control_3D("p", "v", "a", "ground", "cart"), rotation_control_3D("r", "w", "al", "cart", "top"));
  const auto coordinates =
      with(position_control_gen("p", "v", "a", "slide"), prismatic_joint_3D("slide", "ground", "cart", axis::x),
           position_control_gen("r", "w", "al", "turn"), revolute_joint_3D("turn", "cart", "top", axis::z));
  auto s = frames.make_state(), t = coordinates.make_state();
  const std::array q{0.4}, v{-0.7}, a{1.3};
  const std::array<const char*, 6> signals{"p", "v", "a", "r", "w", "al"};
  for (std::size_t i = 0; i < 6; ++i) {
    const double x = 0.3 * static_cast<double>(i + 1);
    s.vector(signals[i]) = i < 3 ? vec3<>{x, 0.0, 0.0} : vec3<>{0.0, 0.0, x};
    t.input(signals[i]) = x;
  }
  const double bound = 50 * std::numeric_limits<double>::epsilon();
  const auto alike = [&](const vec3<>& x, const vec3<>& y) {
    CHECK(gap(eigen(x), eigen(y)) < bound);
    CHECK(eigen(x).norm() > 0.01);
  };
  const auto same = [&](const auto& x, const auto& y) { alike(x.linear, y.linear), alike(x.angular, y.angular); };
  alike(centre_of_mass(frames, s, q).position, centre_of_mass(coordinates, t, q).position);
  alike(centre_of_mass_velocity(frames, s, q, v), centre_of_mass_velocity(coordinates, t, q, v));
  alike(centre_of_mass_acceleration(frames, s, q, v, a), centre_of_mass_acceleration(coordinates, t, q, v, a));
  same(centroidal_momentum(frames, s, q, v), centroidal_momentum(coordinates, t, q, v));
  same(centroidal_momentum_rate(frames, s, q, v, a), centroidal_momentum_rate(coordinates, t, q, v, a));
}

}  // namespace momentum_rate_test
