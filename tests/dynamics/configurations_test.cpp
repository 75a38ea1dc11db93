#include <kte/dynamics/configurations.hpp>

#include <limits>
#include <random>

#include "dynamics/small_chains.hpp"

// Interpolation, distance and random configurations: formulas and laws, static against runtime.

namespace configurations_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double rounding = 20 * eps;  // of numbers below 10, and a logarithm of a rotation

TEST_CASE("interpolation goes from one configuration to the other at constant rates") {
  const auto model = models::element_by_element(floating);
  random_numbers random(1);
  const auto q0 = random_configuration<double>(floating, random);
  const auto q1 = random_configuration<double>(floating, random);
  const auto at = [&](double t) { return interpolate(floating, q0, q1, t); };
  CHECK(gap(difference(floating, q0, at(0)), Eigen::Matrix<double, 11, 1>::Zero()) < rounding);
  CHECK(gap(difference(floating, q1, at(1)), Eigen::Matrix<double, 11, 1>::Zero()) < rounding);
  for (const double t : {-0.5, 0.25, 0.75}) {
    CHECK(gap(difference(floating, q0, at(t)), t * difference(floating, q0, q1)) < 10 * rounding);
    CHECK(gap(interpolate(model, q0, q1, t), at(t)) < rounding);
  }
  // 2 rad - (-2 rad) about z is -2.28 rad by the shorter way.
  Eigen::Matrix<double, 11, 1> a = Eigen::Matrix<double, 11, 1>::Zero(), b = a;
  a[8] = 2, b[8] = -2;
  const auto n = neutral_configuration(floating);
  const auto middle = interpolate(floating, integrate(floating, n, a, 1.0), integrate(floating, n, b, 1.0), 0.5);
  CHECK(std::fabs(middle[10]) == within(1, eps));  // z of the ball's quaternion: turned by pi
}

TEST_CASE("distances of configurations") {
  const auto model = models::element_by_element(planar);
  const std::array q0{0.0, 0.0, 0.5, 1.0}, q1{3.0, 0.0, 0.5, 5.0};
  CHECK(distance(planar, q0, q1) == within(5, 2 * eps * 5));
  CHECK(distance(model, q0, q1) == within(5, 2 * eps * 5));
  const std::array weights{1.0, 1.0, 1.0, 0.0};
  CHECK(distance(planar, q0, q1, weights) == within(3, 2 * eps * 3));
  CHECK(distance(model, q0, q1, weights) == within(3, 2 * eps * 3));
  CHECK(distance(planar, q0, q0) == 0);
  CHECK_THROWS_AS(distance(model, q0, q1, std::array{1.0, 1.0, 1.0, -1.0}), bad_argument);
  CHECK_THROWS_AS(distance(planar, q0, q1, std::vector<double>(3)), bad_argument);
  CHECK_THROWS_AS(distance(model, q0, std::array{0.0, 0.0, 0.0, std::nan("")}), bad_argument);
}

TEST_CASE("random configurations are between limits, rotations anywhere") {
  const auto model = models::element_by_element(floating);
  std::mt19937_64 engine(5);
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(13, -1), upper = Eigen::VectorXd::Constant(13, 3);
  lower[12] = upper[12] = 0.5;
  lower.segment<4>(3).setConstant(std::nan(""));  // not read
  constexpr int count = 4000;
  Eigen::Matrix<double, 13, 1> sum = Eigen::Matrix<double, 13, 1>::Zero(), squares = sum;
  for (int i = 0; i < count; ++i) {
    auto same = engine;
    const auto q = kte::random_configuration(floating, engine, lower, upper);
    if (i == 0) CHECK(kte::random_configuration(model, same, lower, upper) == q);
    for (const int k : {0, 1, 2, 11}) REQUIRE((q[k] >= -1 && q[k] <= 3));
    REQUIRE(q[12] == 0.5);
    for (const int k : {3, 7}) REQUIRE(q.segment<4>(k).norm() == within(1, 4 * eps));
    sum += q, squares += q.cwiseAbs2();
  }
  // Means to five standard deviations: of numbers 4/sqrt(12), of parts of quaternions 1/2, of their squares 1/4.
  const double root = std::sqrt(double(count));
  CHECK(sum[0] / count == within(1, 5 * 1.16 / root));
  CHECK(squares[0] / count == within(1 + 4.0 / 3, 5 * 2.5 / root));
  for (int k = 3; k < 11; ++k) {
    CHECK(sum[k] / count == within(0, 5 * 0.5 / root));
    CHECK(squares[k] / count == within(0.25, 5 * 0.25 / root));
  }
}

TEST_CASE("random configurations of bad limits") {
  const auto model = models::element_by_element(planar);
  std::mt19937_64 engine;
  const std::array q0{0.0, 0.0, 0.0, 0.0}, q1{1.0, 1.0, 1.0, 1.0}, q2{1.0, -1.0, 1.0, 1.0};
  CHECK_THROWS_MATCHES(kte::random_configuration(planar, engine, q0, q2), bad_argument, says("number 1 of q"));
  CHECK_THROWS_AS(kte::random_configuration(model, engine, q0, std::array{1.0, 1.0, 1.0, HUGE_VAL}), bad_argument);
  CHECK_THROWS_AS(kte::random_configuration(model, engine, std::vector<double>(3), q1), bad_argument);
}

}  // namespace configurations_test
