#include <Eigen/Geometry>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "static_models/static_model.hpp"

namespace centroidal_test {

// Centre of mass and momentum: from the bodies one by one, by differences, by the laws of free fall.

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;
using vector3 = static_model<big>::vector3;
using vector6 = static_model<big>::vector6;

/// Sums over at most 13 bodies along at most 8 frames: less than 100 roundings of the largest number, or of 1.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();

/// Mass, centre of mass, and momentum about the centre of mass, as sums over the bodies.
template <class S>
struct sums {
  using vector = typename static_model<S>::vector3;
  S mass{};
  vector first = vector::Zero(), linear = vector::Zero(), angular = vector::Zero();

  sums(const static_model<S>& c, const typename static_model<S>::vector& q, const typename static_model<S>::vector& v) {
    for (const auto& [body, x] : c.bodies(q, v)) {
      const Eigen::Matrix<S, 3, 3> rotation = to_eigen<S>(x.rotation);
      const vector com = eigen(body.com), w = eigen(x.ang_velocity);
      const vector at = eigen(x.position) + rotation * com;
      const vector p = body.mass * (rotation * (eigen(x.velocity) + w.cross(com)));
      mass += body.mass, first += body.mass * at, linear += p;
      angular += rotation * (to_eigen<S>(body.inertia) * w) + at.cross(p);
    }
  }
  vector centre() const { return first / mass; }
  typename static_model<S>::vector6 momentum() const {
    typename static_model<S>::vector6 r;
    r << linear, angular - centre().cross(linear);
    return r;
  }
};

void check_exactly(const model& x, unsigned seed, double exact = 1e-45) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<big> m(x.runtime, random);
    const sums<big> expected(c, m.q, m.v);
    const auto com = c.centre_of_mass(m.q);
    CHECK(abs(big(com.mass - expected.mass)) < exact);
    CHECK(gap(eigen(com.position), expected.centre()) < exact);
    CHECK(gap(c.centre_of_mass_velocity(m.q, m.v), vector3(expected.linear / expected.mass)) < exact);
    CHECK(gap(c.centroidal_momentum(m.q, m.v), expected.momentum()) < exact);
    CHECK(gap(vector6(c.centroidal_momentum_matrix(m.q) * m.v), expected.momentum()) < exact);
    const vector3 moved =
        derivative([&](const big& t) { return vector3(eigen(c.centre_of_mass(c.integrate(m.q, m.v, t)).position)); });
    CHECK(gap(c.centre_of_mass_velocity(m.q, m.v), moved) < by_differences);
  }
}
void check_double(const model& x, unsigned seed) {
  const auto& c = x.in_double;
  random_numbers random(seed);
  auto s = x.runtime.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion<double> m(x.runtime, random);
    const sums<double> expected(c, m.q, m.v);
    const auto com = c.centre_of_mass(m.q), by_runtime = centre_of_mass(x.runtime, s, m.q);
    CHECK(std::fabs(com.mass - expected.mass) < rounding * expected.mass);
    CHECK(std::fabs(by_runtime.mass - expected.mass) < rounding * expected.mass);
    CHECK(gap(eigen(com.position), expected.centre()) < rounding);
    CHECK(gap(eigen(by_runtime.position), expected.centre()) < rounding);
    const Eigen::Vector3d velocity = expected.linear / expected.mass;
    CHECK(gap(c.centre_of_mass_velocity(m.q, m.v), velocity) < rounding);
    CHECK(gap(eigen(centre_of_mass_velocity(x.runtime, s, m.q, m.v)), velocity) < rounding);
    CHECK(gap(c.centroidal_momentum(m.q, m.v), expected.momentum()) < rounding);
    CHECK(gap(eigen(centroidal_momentum(x.runtime, s, m.q, m.v)), expected.momentum()) < rounding);
    const Eigen::MatrixXd map = c.centroidal_momentum_matrix(m.q);
    CHECK(gap(Eigen::VectorXd(map * m.v), expected.momentum()) < rounding);
    CHECK(gap(centroidal_momentum_matrix(x.runtime, s, m.q), map) < rounding);
  }
}
/// Whatever motors do inside, momentum changes by weight alone, and angular momentum about the centre of mass stays.
/// tau acts on all but the first `outside` degrees of freedom.
template <class Chain>
void check_free_fall(const model& x, const Chain& chain, int outside, unsigned seed) {
  const auto& c = x.exact;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    random_motion<big> m(x.runtime, random);
    auto tau = small_chains::random_vector<big, Chain::dofs>(random, 20);
    tau.head(outside).setZero();
    m.a = forward_dynamics(chain, m.q, m.v, tau);
    const vector6 change =
        derivative([&](const big& t) { return c.centroidal_momentum(m.position_at(c, t), m.velocity_at(t)); });
    vector6 expected = vector6::Zero();
    expected.head<3>() = c.centre_of_mass(m.q).mass * to_eigen<big>(c.gravity);
    // Accelerations reach 1e3, third derivatives of momentum 1e9.
    CHECK(gap(change, expected) < 1e6 * by_differences);
  }
}

TEST_CASE("centre of mass and momentum from the bodies, at 50 digits") {
  // Its first two links lie along one fixed axis, so that poses add their lengths in double.
  check_exactly(static_models::iiwa14(), 1, 1e-15);
  check_exactly(static_models::floating(), 2);
  check_exactly(static_models::planar(), 3);
  check_exactly(static_models::geared(), 4);
}

TEST_CASE("centre of mass and momentum in double, and of runtime chains") {
  check_double(static_models::iiwa14(), 11);
  check_double(static_models::floating_with_dampers(), 13);
  check_double(static_models::planar(), 14);
  check_double(static_models::geared(), 15);
  check_double(static_models::tree(), 16);
}

TEST_CASE("momentum in free fall") {
  check_free_fall(static_models::floating(), floating, 6, 21);
  check_free_fall(static_models::floating_with_springs(), floating_with_springs, 6, 22);
}

TEST_CASE("centre of mass of point masses") {
  const auto c = chain(prismatic_joint_3D(q1, ground, body, axis::x), inertia_3D(body, point_mass(3.0)),
                       rigid_link_3D(body, tip, along_z(2.0)), inertia_3D(tip, point_mass(1.0)));
  const auto com = centre_of_mass(c, std::array{0.5});
  CHECK(com.mass == 4);
  CHECK(com.position == vec3<>{0.5, 0.0, 0.5});
  CHECK(centre_of_mass_velocity(c, std::array{0.5}, std::array{2.0}) == vec3<>{2.0, 0.0, 0.0});
  const auto h = centroidal_momentum(c, std::array{0.5}, std::array{2.0});
  CHECK(h.linear == vec3<>{8.0, 0.0, 0.0});
  CHECK(h.angular == vec3<>{0.0, 0.0, 0.0});
  CHECK(centroidal_momentum_matrix(c, std::array{0.5}) == Eigen::Matrix<double, 6, 1>::Unit(0) * 4);
}

TEST_CASE("centre of mass and momentum of bad arguments") {
  const auto& c = robots::iiwa14;
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  const std::array<double, 7> good{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const std::vector two{1.0, 2.0};
  CHECK_THROWS_AS(centre_of_mass(c, two), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum_matrix(c, two), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum(c, good, two), bad_argument);
  CHECK_THROWS_AS(centre_of_mass_velocity(c, good, two), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum_matrix(model, s, two), bad_argument);
  const auto light = chain(prismatic_joint_3D(q1, ground, body, axis::x), inertia_3D(body, point_mass(0.0)));
  CHECK_THROWS_AS(centre_of_mass(light, std::array{0.5}), bad_argument);
  CHECK_THROWS_AS(centroidal_momentum_matrix(light, std::array{0.5}), bad_argument);
  const auto light_model = models::element_by_element(light);
  auto light_state = light_model.make_state();
  CHECK_THROWS_AS(centre_of_mass(light_model, light_state), bad_argument);
  for (std::size_t i = 0; i < 7; ++i) {
    auto bad = good;
    bad[i] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(centre_of_mass(c, bad), bad_argument);
    CHECK_THROWS_AS(centroidal_momentum_matrix(c, bad), bad_argument);
    CHECK_THROWS_AS(centroidal_momentum(c, bad, good), bad_argument);
    CHECK_THROWS_AS(centroidal_momentum(c, good, bad), bad_argument);
    CHECK_THROWS_AS(centre_of_mass_velocity(c, good, bad), bad_argument);
    CHECK_THROWS_AS(centre_of_mass(model, s, bad), bad_argument);
    CHECK_THROWS_AS(centroidal_momentum_matrix(model, s, bad), bad_argument);
    CHECK_THROWS_AS(centroidal_momentum(model, s, good, bad), bad_argument);
    CHECK_THROWS_AS(centre_of_mass_velocity(model, s, good, bad), bad_argument);
  }
}

}  // namespace centroidal_test
