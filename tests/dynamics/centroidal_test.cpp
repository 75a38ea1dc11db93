#include <Eigen/Geometry>

#include <limits>

#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"

// Centre of mass and momentum: from the bodies one by one, by differences, by the laws of free fall.

namespace centroidal_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// Sums over at most 13 bodies along at most 8 frames: less than 100 roundings of the largest number, or of 1.
constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();

/// Mass, centre of mass, and momentum about the centre of mass, as sums over the bodies with poses and velocities of
/// their frames.
template <class S>
struct sums {
  S mass{};
  Eigen::Matrix<S, 3, 1> first = zero_vector(), linear = zero_vector(), angular = zero_vector();
  static Eigen::Matrix<S, 3, 1> zero_vector() { return {S(0), S(0), S(0)}; }

  Eigen::Matrix<S, 3, 1> centre() const { return first / mass; }
  Eigen::Matrix<S, 6, 1> momentum() const {
    Eigen::Matrix<S, 6, 1> r;
    r << linear, angular - centre().cross(linear);
    return r;
  }
  template <class Chain, class Q, class V, class Core, class Frame>
  void add(const Chain& c, const Q& q, const V& v, const element<Core, Frame>& e) {
    if constexpr (requires { e.core.body; }) {
      using vector = Eigen::Matrix<S, 3, 1>;
      const auto x = in_space(forward_kinematics(c, q, Frame{}));
      const auto rates = frame_velocity(c, q, v, Frame{});
      const vector com = to_eigen<S>(e.core.body.com), w = eigen(rates.angular);
      const S m = as<S>(e.core.body.mass);
      const vector at = x.position + x.rotation * com;
      const vector p = m * (x.rotation * (eigen(rates.linear) + w.cross(com)));
      mass += m, first += m * at, linear += p;
      angular += x.rotation * (to_eigen<S>(e.core.body.inertia) * w) + at.cross(p);
    }
  }
  template <class Chain, class Q, class V, class Core, class... Keys>
  void add(const Chain&, const Q&, const V&, const element<Core, Keys...>&) {}

  template <class Chain, class Q, class V>
  sums(const Chain& c, const Q& q, const V& v) {
    boost::hana::for_each(c.elements(), [&](const auto& e) { add(c, q, v, e); });
  }
};

template <class Chain>
void check_exactly(const Chain& c, unsigned seed, double exact = 1e-45) {
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion_of<big, Chain> m(c, random);
    const sums<big> expected(c, m.q, m.v);
    const auto com = centre_of_mass(c, m.q);
    CHECK(abs(big(com.mass - expected.mass)) < exact);
    CHECK(gap(eigen(com.position), expected.centre()) < exact);
    CHECK(gap(eigen(centre_of_mass_velocity(c, m.q, m.v)), (expected.linear / expected.mass).eval()) < exact);
    CHECK(gap(eigen(centroidal_momentum(c, m.q, m.v)), expected.momentum()) < exact);
    CHECK(gap((centroidal_momentum_matrix(c, m.q) * m.v).eval(), expected.momentum()) < exact);
    const Eigen::Matrix<big, 3, 1> moved = derivative([&](const big& t) {
      return Eigen::Matrix<big, 3, 1>(eigen(centre_of_mass(c, integrate(c, m.q, m.v, t)).position));
    });
    CHECK(gap(eigen(centre_of_mass_velocity(c, m.q, m.v)), moved) < by_differences);
  }
}
template <class Chain>
void check_double(const Chain& c, unsigned seed) {
  random_numbers random(seed);
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  for (int round = 0; round < 20; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const sums<double> expected(c, m.q, m.v);
    const auto com = centre_of_mass(c, m.q), by_runtime = centre_of_mass(model, s, m.q);
    CHECK(std::fabs(com.mass - expected.mass) < rounding * expected.mass);
    CHECK(std::fabs(by_runtime.mass - expected.mass) < rounding * expected.mass);
    CHECK(gap(eigen(com.position), expected.centre()) < rounding);
    CHECK(gap(eigen(by_runtime.position), expected.centre()) < rounding);
    const auto velocity = (expected.linear / expected.mass).eval();
    CHECK(gap(eigen(centre_of_mass_velocity(c, m.q, m.v)), velocity) < rounding);
    CHECK(gap(eigen(centre_of_mass_velocity(model, s, m.q, m.v)), velocity) < rounding);
    CHECK(gap(eigen(centroidal_momentum(c, m.q, m.v)), expected.momentum()) < rounding);
    CHECK(gap(eigen(centroidal_momentum(model, s, m.q, m.v)), expected.momentum()) < rounding);
    const auto map = centroidal_momentum_matrix(c, m.q);
    CHECK(gap((map * m.v).eval(), expected.momentum()) < rounding);
    CHECK(gap(centroidal_momentum_matrix(model, s, m.q), map) < rounding);
  }
}
/// Whatever motors do inside, momentum changes by weight alone, and angular momentum about the centre of mass stays.
/// tau acts on all but the first `outside` degrees of freedom.
template <class Chain>
void check_free_fall(const Chain& c, int outside, unsigned seed) {
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    random_motion_of<big, Chain> m(c, random);
    joint_vector<big, Chain::dofs> tau = random_vector<big, Chain::dofs>(random, 20);
    tau.head(outside).setZero();
    m.a = forward_dynamics(c, m.q, m.v, tau);
    const Eigen::Matrix<big, 6, 1> change = derivative([&](const big& t) {
      return Eigen::Matrix<big, 6, 1>(eigen(centroidal_momentum(c, position_at(c, m, t), velocity_at(m, t))));
    });
    Eigen::Matrix<big, 6, 1> expected = Eigen::Matrix<big, 6, 1>::Zero();
    expected.head<3>() = centre_of_mass(c, m.q).mass * to_eigen<big>(c.gravity());
    // Accelerations reach 1e3, third derivatives of momentum 1e9.
    CHECK(gap(change, expected) < 1e6 * by_differences);
  }
}

TEST_CASE("centre of mass and momentum from the bodies, at 50 digits") {
  // Its first two links lie along one fixed axis, so that poses add their lengths in double.
  check_exactly(robots::iiwa14, 1, 1e-15);
  check_exactly(floating, 2);
  check_exactly(planar, 3);
  check_exactly(geared, 4);
}

TEST_CASE("centre of mass and momentum in double, and of runtime chains") {
  check_double(robots::iiwa14, 11);
  check_double(floating_with_dampers, 13);
  check_double(planar, 14);
  check_double(geared, 15);
  check_double(models::tree, 16);
}

TEST_CASE("momentum in free fall") {
  check_free_fall(floating, 6, 21);
  check_free_fall(floating_with_springs, 6, 22);
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
