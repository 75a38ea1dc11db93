#include "catch.hpp"
#include "frames/random_motion.hpp"

namespace inverse_test {

using namespace kte;
using namespace kte::test;

const digits50 eps50 = std::numeric_limits<digits50>::epsilon();
const digits50 by_differences = 1000 * pow(eps50, digits50(2) / 3);  // as for compose

/// Some 30 roundings of eps/2 in a composition, and as many in the inverse.
template <class S>
const S rounding = 30 * std::numeric_limits<S>::epsilon();

template <class S, class R>
void check_inverse(unsigned seed) {
  random_numbers draw(seed);
  const auto here = at_rest(no_rotation{}, zero3{});
  for (int i = 0; i < 50; ++i) {
    const auto a = random_motion<S, R>(draw), b = random_motion<S, R>(draw);
    CHECK(apart<S>(compose(a, inverse(a)), here) <= rounding<S>);
    CHECK(apart<S>(compose(inverse(a), a), here) <= rounding<S>);
    CHECK(apart<S>(inverse(inverse(a)), a) <= rounding<S>);
    CHECK(apart<S>(relative(a, a), here) <= rounding<S>);
    CHECK(apart<S>(relative(a, compose(a, b)), b) <= 2 * rounding<S>);
    CHECK(apart<S>(inverse(compose(a, b)), compose(inverse(b), inverse(a))) <= 2 * rounding<S>);
  }
}

TEST_CASE("a motion and its inverse are a frame at rest") {
  check_inverse<double, mat3<vec3<>>>(1);
  check_inverse<double, unit_quaternion<>>(2);
  check_inverse<digits50, mat3<vec3<digits50>>>(3);
}

TEST_CASE("inverse and relative motion by differences") {
  random_numbers draw(4);
  const auto check = [&]<class R>(R) {
    for (int i = 0; i < 10; ++i) {
      const curve<digits50, R> a(draw), b(draw);
      const auto back = [&](const digits50& t) { return inverse(a(t)); };
      const auto between = [&](const digits50& t) { return compose(inverse(a(t)), b(t)); };
      const auto A = motion_along<digits50>(a), B = motion_along<digits50>(b);
      CHECK(apart<digits50>(inverse(A), motion_along<digits50>(back)) <= by_differences);
      CHECK(apart<digits50>(relative(A, B), motion_along<digits50>(between)) <= by_differences);
    }
  };
  check(mat3<vec3<digits50>>{});
  check(unit_quaternion<digits50>{});
  check(rotation_2D<digits50>{1, 0});
}

TEST_CASE("axes of the parent") {
  random_numbers draw(5);
  for (int i = 0; i < 20; ++i) {
    const curve<digits50, mat3<vec3<digits50>>> c(draw);
    const auto m = in_parent_axes(motion_along<digits50>(c));
    const auto [first, second] = testing::detail::derivatives<digits50>([&c](const digits50& t) {
      const auto p = c(t).position;
      return std::array{p.x, p.y, p.z};
    });
    const auto near = [](const vec3<digits50>& v, const std::array<digits50, 3>& d) {
      return testing::detail::difference<digits50, 3>({v.x, v.y, v.z}, d) <= by_differences;
    };
    CHECK(near(m.velocity, first));
    CHECK(near(m.acceleration, second));
  }
  const auto w = in_parent_axes(quarter_turn_z, wrench{vec3{1.0, 2.0, 3.0}, vec3{4.0, 5.0, 6.0}});
  CHECK(as<double>(w.force) == vec3{-2.0, 1.0, 3.0});
  CHECK(as<double>(w.torque) == vec3{-5.0, 4.0, 6.0});
}

TEST_CASE("poses carry points") {
  random_numbers draw(6);
  const auto distance = [](const vec3<>& a, const vec3<>& b) {
    return test::worse(test::worse(std::abs(a.x - b.x), std::abs(a.y - b.y)), std::abs(a.z - b.z));
  };
  for (int i = 0; i < 50; ++i) {
    const auto m = random_motion<double>(draw);
    const auto n = random_motion<double, unit_quaternion<>>(draw);
    const pose a{m.rotation, m.position};
    const pose b{n.rotation, n.position};
    const auto x = random_vector<double>(draw);
    CHECK(distance(to_parent(compose(a, b), x), to_parent(a, to_parent(b, x))) <= rounding<double>);
    CHECK(distance(to_parent(inverse(a), to_parent(a, x)), x) <= rounding<double>);
    CHECK(distance(to_parent(compose(a, inverse(b)), to_parent(b, x)), to_parent(a, x)) <= rounding<double>);
  }
  static_assert(std::is_same_v<decltype(inverse(pose{no_rotation{}, zero3{}})), pose<no_rotation, zero3>>);
  CHECK(as<double>(to_parent(pose{quarter_turn_z, along_x(1.0)}, vec3{2.0, 0.5, 3.0})) == vec3{0.5, 2.0, 3.0});
}

}  // namespace inverse_test
