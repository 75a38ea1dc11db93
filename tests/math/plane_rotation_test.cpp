#include <kte/math/axis.hpp>
#include <kte/math/plane_rotation.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "random.hpp"

namespace plane_rotation_test {

using namespace kte;
using kte::test::worse;

double gap(double a, double b) { return std::fabs(a - b); }
double largest(const vec3<>& a, const vec3<>& b) { return worse(worse(gap(a.x, b.x), gap(a.y, b.y)), gap(a.z, b.z)); }
double largest(const mat3<>& a, const mat3<>& b) {
  return worse(worse(largest(a.x, b.x), largest(a.y, b.y)), largest(a.z, b.z));
}
double largest(const sym3<>& a, const sym3<>& b) { return largest(full(a), full(b)); }

/// Entries are below 1, their products with cosines and sines below 2: four roundings on the way through w.
constexpr double by_rounding = 4 * 2 * std::numeric_limits<double>::epsilon();

TEST_CASE("which rotations are known to be in a plane") {
  const auto in_a_plane = []<class R>(const R&) { return detail::turns_in_a_plane<R>; };
  const auto turn = rotation_about(axis::x, 0.3);
  CHECK_FALSE(in_a_plane(as<double>(turn)));
  CHECK_FALSE(in_a_plane(quarter_turn_x));
  CHECK_FALSE(in_a_plane(turn * rotation_about(axis::y, 0.3)));
  CHECK_FALSE(in_a_plane(mat3{vec3{constant<2>{}, zero, zero}, vec3{zero, 0.6, -0.8}, vec3{zero, 0.8, 0.6}}));
}

TEST_CASE("a matrix turned in a plane is that of the matrix") {
  random_numbers random(91);
  const auto entries = [&] { return vec3{random(1), random(1), random(1)}; };
  const auto check_rotation = [&](const auto& r) {
    STATIC_REQUIRE(detail::turns_in_a_plane<std::remove_cvref_t<decltype(r)>>);
    const mat3 dense = as<double>(r);
    const mat3 a{entries(), entries(), entries()};
    const sym3 s{random(1), random(1), random(1), random(1), random(1), random(1)};
    CHECK(largest(as<double>(turned_by(r, a)), turned_by(dense, a)) < by_rounding);
    CHECK(largest(as<double>(turned_by(r, s)), turned_by(dense, s)) < by_rounding);
  };
  const auto check = [&](const auto& axis) {
    const auto r = rotation_about(axis, random(3));
    check_rotation(r);
    check_rotation(quarter_turn_x * r);
    check_rotation(minus_quarter_turn_y * r * quarter_turn_z);
    check_rotation(half_turn_y * r);
  };
  for (int i = 0; i < 100; ++i) {
    check(axis::x), check(axis::y), check(axis::z);
    check(axis::minus_x), check(axis::minus_y), check(axis::minus_z);
  }
}

}  // namespace plane_rotation_test
