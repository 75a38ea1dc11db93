#include <kte/frames/motion.hpp>

#include <limits>
#include <numbers>

#include "catch.hpp"
#include "math/draw.hpp"
#include "math/gap.hpp"

namespace rotation_test {

using namespace kte;
using test::gap;

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double pi = std::numbers::pi;

TEST_CASE("no rotation") {
  const mat3<> identity = as<double>(matrix(no_rotation{}));
  CHECK(unit_quaternion<>{} == unit_quaternion{1.0, 0.0, 0.0, 0.0});
  CHECK(matrix(unit_quaternion<>{}) == identity);
  CHECK(to_quaternion(identity) == unit_quaternion<>{});
  CHECK(to_quaternion(vec3{0.0, 0.0, 0.0}) == unit_quaternion<>{});
  CHECK(to_quaternion(zero3{}) == unit_quaternion<>{});
  CHECK(to_quaternion(axis_angle<>{}) == unit_quaternion<>{});
  CHECK(to_axis_angle(identity) == axis_angle<>{0.0, {1.0, 0.0, 0.0}});
  CHECK(to_axis_angle(unit_quaternion{-1.0, 0.0, 0.0, 0.0}) == axis_angle<>{});
  CHECK(to_rotation_vector(identity) == vec3{0.0, 0.0, 0.0});
  CHECK(matrix(axis_angle<>{0.0, {0.0, 0.6, 0.8}}) == identity);
}

TEST_CASE("typed rotations are exact") {
  const double h = std::sqrt(0.5);
  CHECK(gap(to_quaternion(quarter_turn_x), {h, h, 0.0, 0.0}) <= eps);
  CHECK(gap(to_quaternion(quarter_turn_y), {h, 0.0, h, 0.0}) <= eps);
  CHECK(gap(to_quaternion(minus_quarter_turn_z), {h, 0.0, 0.0, -h}) <= eps);
  CHECK(to_quaternion(half_turn_x) == unit_quaternion{0.0, 1.0, 0.0, 0.0});
  CHECK(to_quaternion(half_turn_y) == unit_quaternion{0.0, 0.0, 1.0, 0.0});
  CHECK(to_axis_angle(half_turn_z) == axis_angle<>{pi, {0.0, 0.0, 1.0}});
  CHECK(gap(to_rotation_vector(quarter_turn_y), {0.0, pi / 2, 0.0}) <= eps);
  CHECK(gap(to_rotation_vector(matrix(along_z(0.25))), {0.0, 0.0, 0.25}) <= eps);
  static_assert(half_turn_x * half_turn_x == matrix(no_rotation{}));
  static_assert(quarter_turn_x * minus_quarter_turn_x == matrix(no_rotation{}));
  static_assert(quarter_turn_z * axis::x == axis::y && quarter_turn_x * axis::y == axis::z);
  static_assert(quarter_turn_y * axis::z == axis::x && half_turn_y * axis::x == axis::minus_x);
  static_assert(quarter_turn * quarter_turn == half_turn &&
                quarter_turn * minus_quarter_turn == rotation_2D{one, zero});
  static_assert(matrix(quarter_turn) == quarter_turn_z && matrix(half_turn) == half_turn_z);
}

TEST_CASE("rotations about typed axes are the general ones") {
  // c + (1 - c) u^2 for u = 1 may differ from 1 by the rounding of 1 - c. t n, up to 4, is rounded by an eps or two,
  // and a matrix has 6.
  test::draw draw(33);
  for (int i = 0; i < 1000; ++i) {
    const double t = 4 * draw.number();
    const auto check = [t](const auto& n) {
      CHECK(gap(as<double>(rotation_about(n, t)), rotation_about(as<double>(n), t)) <= eps);
      CHECK(gap(as<double>(rotation_about(n, t)), matrix(as<double>(t * n))) <= 8 * eps);
    };
    check(axis::x), check(axis::y), check(axis::z);
    check(axis::minus_x), check(axis::minus_y), check(axis::minus_z);
    check(vec3{zero, std::cos(t), std::sin(t)});
    check(vec3{std::sin(t), zero, std::cos(t)});
  }
}

TEST_CASE("quaternions turn vectors, frames and inertias as their matrices do") {
  // Numbers up to 2 and their products: as the round trips.
  test::draw draw(34);
  for (int i = 0; i < 10000; ++i) {
    const auto a = draw.rotation(), b = draw.rotation();
    const auto m = draw.matrix();
    const auto s = draw.symmetric();
    const auto v = draw.vector();
    REQUIRE(gap(a * v, matrix(a) * v) <= 8 * eps);
    REQUIRE(gap(a * vec3{zero, v.y, zero}, matrix(a) * vec3{0.0, v.y, 0.0}) <= 8 * eps);
    REQUIRE(gap(transpose(a) * v, transpose(matrix(a)) * v) <= 8 * eps);
    REQUIRE(gap(matrix(a * b), matrix(a) * matrix(b)) <= 12 * eps);
    REQUIRE(gap(transpose(a) * a, unit_quaternion<>{}) <= 4 * eps);
    REQUIRE(std::abs(dot(a, b) - (conjugate(a) * b).w) <= eps);
    REQUIRE((a * m == matrix(a) * m && m * a == m * matrix(a)));
    REQUIRE((a * no_rotation{} == a && no_rotation{} * a == a));
    REQUIRE(congruence(a, s) == congruence(matrix(a), s));
    REQUIRE(gap(matrix_of_any_length(unit_quaternion{3 * a.w, 3 * a.x, 3 * a.y, 3 * a.z}), matrix(a)) <= 12 * eps);
    const auto x = compose(at_rest(a, v), at_rest(b, v));
    const auto y = compose(at_rest(matrix(a), v), at_rest(matrix(b), v));
    REQUIRE(gap(matrix(x.rotation), y.rotation) <= 12 * eps);
    REQUIRE(gap(x.position, y.position) <= 8 * eps);
  }
  static_assert(unit_quaternion<>{} * axis::x == vec3{1.0, 0.0, 0.0});
  static_assert(std::is_same_v<decltype(unit_quaternion<>{} * zero3{}), zero3>);
  static_assert(as<float>(unit_quaternion{0.0, 1.0, 0.0, 0.0}) == unit_quaternion{0.0f, 1.0f, 0.0f, 0.0f});
}

TEST_CASE("quaternions of any length are brought to length 1") {
  for (const double size : {5e-324, 1e-308, 1e-160, 1.0, 1e160, 1e308}) {
    CHECK(gap(normalized(size, -size, size, -size), {0.5, -0.5, 0.5, -0.5}) <= eps);
    CHECK(normalized(0.0, size, 0.0, 0.0) == unit_quaternion{0.0, 1.0, 0.0, 0.0});
    CHECK(gap(matrix_of_any_length(unit_quaternion{size, -size, size, -size}),
              matrix(unit_quaternion{0.5, -0.5, 0.5, -0.5})) <= 4 * eps);
  }
  CHECK(normalized(-3, 0, 4, 0) == unit_quaternion{-0.6, 0.0, 0.8, 0.0});
  for (const double bad : {0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    CHECK(std::isnan(matrix_of_any_length(unit_quaternion{0.0, bad, 0.0, 0.0}).x.x));
}

TEST_CASE("matrices that are not rotations are rejected") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(normalized(0.0, 0.0, 0.0, 0.0), bad_argument);
  for (const double bad : {inf, -inf, nan}) {
    CHECK_THROWS_AS(normalized(bad, 0.0, 0.0, 0.0), bad_argument);
    CHECK_THROWS_AS(normalized(1.0, 0.0, bad, 0.0), bad_argument);
    CHECK_THROWS_AS(normalized(1.0, 0.0, 0.0, bad), bad_argument);
    CHECK_THROWS_AS(normalized(bad, bad, bad, bad), bad_argument);
  }
  test::draw draw(35);
  const auto good = matrix(draw.rotation());
  const auto entry = [](mat3<>& m, int i) -> double& {
    auto& row = i < 3 ? m.x : i < 6 ? m.y : m.z;
    return i % 3 == 0 ? row.x : i % 3 == 1 ? row.y : row.z;
  };
  for (int i = 0; i < 9; ++i) {
    for (const double bad : {inf, -inf, nan, 2.0}) {
      auto m = good;
      entry(m, i) = bad;
      CHECK_THROWS_AS(to_quaternion(m), bad_argument);
      CHECK_THROWS_AS(to_axis_angle(m), bad_argument);
      CHECK_THROWS_AS(to_rotation_vector(m), bad_argument);
    }
    auto m = good;
    entry(m, i) += 1e-5;
    CHECK_THROWS_AS(to_quaternion(m), bad_argument);
    m = good;
    entry(m, i) += 1e-8;
    CHECK(gap(to_quaternion(m), to_quaternion(good)) <= 1e-8);
    CHECK(std::abs(dot(to_quaternion(m), to_quaternion(m)) - 1) <= 4 * eps);
  }
  CHECK_THROWS_AS(to_quaternion(mat3<>{-good.x, good.y, good.z}), bad_argument);
  CHECK_THROWS_AS(to_quaternion(mat3<>{good.y, good.x, good.z}), bad_argument);
  CHECK_THROWS_AS(to_quaternion(mat3<>{}), bad_argument);
  const auto a = to_axis_angle(unit_quaternion<>{1.0, 0.0, nan, 0.0});
  CHECK(std::isnan(a.angle));
  CHECK(std::isnan(to_axis_angle(unit_quaternion<>{nan, 0.0, 0.0, 0.0}).angle));
  CHECK(std::isnan(to_rotation_vector(unit_quaternion<>{1.0, 0.0, nan, 0.0}).y));
}

}  // namespace rotation_test
