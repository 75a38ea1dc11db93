
#include "digits50.hpp"
#include "dynamics/configurations.hpp"

// Configurations with rotations and poses in them: how to get from one to another.

namespace configuration_space_test {

using namespace kte;
using namespace kte::test::configurations;

template <class V>
auto part(const V& x, int first, int n) {
  return x.segment(first, n).eval();
}

TEST_CASE("static and runtime chains integrate to the same numbers") {
  const auto runtime = models::element_by_element(model);
  random_numbers random(1);
  CHECK(neutral_configuration(runtime) == neutral_configuration(model));
  for (int round = 0; round < 50; ++round) {
    const auto q = random_configuration<double>(random), p = random_configuration<double>(random);
    const auto v = random_vector<double, nv>(random, 5);
    const double dt = random();
    CHECK(integrate(runtime, q, v, dt) == integrate(model, q, v, dt));
    CHECK(difference(runtime, q, p) == difference(model, q, p));
  }
}

TEST_CASE("in the neutral configuration nothing is moved or turned") {
  const auto q = neutral_configuration(model);
  for (int i = 0; i < nq; ++i) CHECK(q[i] == (i == 4 || i == 8 ? 1.0 : 0.0));
  const auto x = forward_kinematics(model, q, tip);
  CHECK(x.position == vec3{0.0, 0.0, 0.0});
  CHECK(x.rotation == mat3<>{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}});
  CHECK(difference(model, q, q) == joint_vector<double, nv>::Zero());
  CHECK(integrate(model, q, joint_vector<double, nv>(joint_vector<double, nv>::Zero()), 1.0) == q);
  auto s = make_state(model);  // a new state is in it
  CHECK(positions(s) == q);
  CHECK(neutral_configuration<kte::test::digits50>(model)[4] == 1);
}

TEST_CASE("the difference is what integrate needs") {
  random_numbers random(2);
  for (int round = 0; round < 200; ++round) {
    const auto q = random_configuration<double>(random);
    auto v = random_vector<double, nv>(random, 1.7);  // rotations by less than pi
    // A product of quaternions, an exponential and a logarithm: some 30 roundings of numbers up to 20.
    CHECK((difference(model, q, integrate(model, q, v, 1.0)) - v).cwiseAbs().maxCoeff() < 30 * eps * 20);
    const auto p = random_configuration<double>(random);
    const auto there = integrate(model, q, difference(model, q, p), 1.0);
    CHECK(part(there, 0, 4).isApprox(part(p, 0, 4), 100 * eps));
    CHECK(1 - std::abs(part(there, 4, 4).dot(part(p, 4, 4))) < 30 * eps);  // q and -q are the same
    CHECK(1 - std::abs(part(there, 8, 4).dot(part(p, 8, 4))) < 30 * eps);
    CHECK(part(there, 12, 3).isApprox(part(p, 12, 3), 100 * eps));
    const double pi = std::atan2(0.0, -1.0);
    CHECK(std::abs(std::remainder(there[15] - p[15], 2 * pi)) < 30 * eps);
    CHECK(std::abs(difference(model, q, p)[13]) <= pi);
    // Constant v: the way from time s to t is (t - s) v.
    const double s = random(), t = s + 0.3;
    const auto way = difference(model, integrate(model, q, v, s), integrate(model, q, v, t));
    CHECK((way - 0.3 * v).cwiseAbs().maxCoeff() < 60 * eps * 20);
  }
}

TEST_CASE("numbers are just added, angles without end") {
  auto q = neutral_configuration(model);
  joint_vector<double, nv> v = joint_vector<double, nv>::Zero();
  q[0] = 0.5, q[12] = -1.0, q[15] = 100.0, v[0] = 3.0, v[10] = 4.0, v[13] = 8.0;
  const auto p = integrate(model, q, v, 0.25);
  CHECK(p[0] == 1.25);
  CHECK(p[12] == 0.0);
  CHECK(p[15] == 102.0);
  CHECK(difference(model, q, p)[0] == 0.75);
  CHECK(difference(model, q, p)[13] == within(2.0, 200 * eps));
  v[13] = 4 * 5.0;  // more than half a turn: the shorter way
  CHECK(difference(model, q, integrate(model, q, v, 0.25))[13] == within(5.0 - 2 * std::atan2(0.0, -1.0), 200 * eps));
}

TEST_CASE("the plane is space about z") {
  constexpr auto in_plane = chain(free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(1.0, 1.0)));
  constexpr auto solid = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(1.0)));
  random_numbers random(3);
  for (int round = 0; round < 100; ++round) {
    const double x = random(), y = random(), t = random(3), vx = random(), vy = random(), w = random(), dt = random(2);
    const auto flat = integrate(in_plane, std::array{x, y, t}, std::array{vx, vy, w}, dt);
    const auto p = integrate(solid, std::array{x, y, 0.0, std::cos(t / 2), 0.0, 0.0, std::sin(t / 2)},
                             std::array{vx, vy, 0.0, 0.0, 0.0, w}, dt);
    CHECK(flat[0] == within(p[0], 20 * eps));
    CHECK(flat[1] == within(p[1], 20 * eps));
    CHECK(p[2] == 0.0);
    CHECK(std::remainder(flat[2] - 2 * std::atan2(p[6], p[3]), 2 * std::atan2(0.0, -1.0)) == within(0.0, 20 * eps));
    const auto back = difference(in_plane, std::array{x, y, t}, std::array{flat[0], flat[1], flat[2]});
    CHECK(back[0] == within(vx * dt, 40 * eps));
    CHECK(back[2] == within(w * dt, 40 * eps));
  }
}

TEST_CASE("quaternions keep length 1 for ever") {
  constexpr auto c = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, point_mass(1.0)));
  joint_vector<double, 7> q = neutral_configuration(c);
  joint_vector<double, 6> v;
  v << 0.1, -0.2, 0.3, 1.0, -2.0, 0.5;
  double worst = 0;
  for (int i = 0; i < 1'000'000; ++i) {
    q = integrate(c, q, v, 1e-3);
    worst = test::worse(worst, std::abs(q.tail(4).squaredNorm() - 1));
  }
  CHECK(worst < 4 * eps);  // of the division by the length, twice in the square
  // One step of the same time: its angle of 2291 rad is wrong by 2291 eps, and each of the steps by a few eps.
  const auto one = integrate(c, neutral_configuration(c), v, 1e3);
  CHECK(1 - std::abs(one.tail(4).dot(q.tail(4))) < 1e-15);
  CHECK((one.head(3) - q.head(3)).norm() < 1e-9);
}

TEST_CASE("quaternions of any length are taken, of length 0 and NaN refused") {
  random_numbers random(6);
  const auto runtime = models::element_by_element(model);
  const auto q = random_configuration<double>(random), p = random_configuration<double>(random);
  const auto v = random_vector<double, nv>(random, 1);
  for (const double size : {1.5, 1e-200, 1e200}) {
    auto scaled = q;
    scaled.segment(4, 4) *= size, scaled.segment(8, 4) *= size;
    CHECK((integrate(model, scaled, v, 0.1) - integrate(model, q, v, 0.1)).cwiseAbs().maxCoeff() < 20 * eps);
    CHECK((difference(model, scaled, p) - difference(model, q, p)).cwiseAbs().maxCoeff() < 100 * eps);
  }
  const std::string what = "kte: a quaternion of length 0, or one that is not finite, is not a rotation";
  const auto check = [&](const auto& c) {
    for (const int first : {4, 8}) {
      auto bad = q;
      bad.segment(first, 4).setZero();
      CHECK_THROWS_AS(integrate(c, bad, v, 0.1), bad_argument);
      CHECK_THROWS_WITH(integrate(c, bad, v, 0.1), what);
      CHECK_THROWS_WITH(difference(c, bad, q), what);
      CHECK_THROWS_WITH(difference(c, q, bad), what);
      for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        bad = q;
        bad[first + 1] = x;
        CHECK_THROWS_WITH(integrate(c, bad, v, 0.1), what);
        CHECK_THROWS_WITH(difference(c, q, bad), what);
      }
    }
  };
  check(model);
  check(runtime);
}

}  // namespace configuration_space_test
