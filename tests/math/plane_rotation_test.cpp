#include <kte/math/axis.hpp>
#include <kte/math/plane_rotation.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "random.hpp"

using namespace kte;
using kte::test::worse;

namespace {

double gap(double a, double b) { return std::fabs(a - b); }
double largest(const vec3<>& a, const vec3<>& b) { return worse(worse(gap(a.x, b.x), gap(a.y, b.y)), gap(a.z, b.z)); }
double largest(const mat3<>& a, const mat3<>& b) {
  return worse(worse(largest(a.x, b.x), largest(a.y, b.y)), largest(a.z, b.z));
}
double largest(const sym3<>& a, const sym3<>& b) { return largest(full(a), full(b)); }

/// Entries are below 1, their products with cosines and sines below 2: four roundings on the way through w.
constexpr double by_rounding = 4 * 2 * std::numeric_limits<double>::epsilon();

}  // namespace

TEST_CASE("a matrix turned in a plane is that of the matrix", "[math][rotation]") {
  random_numbers random(91);
  const auto entries = [&] { return vec3{random(1), random(1), random(1)}; };
  const auto check = [&](const auto& axis) {
    const auto r = rotation_about(axis, random(3));
    const mat3 dense = as<double>(r);
    const mat3 a{entries(), entries(), entries()};
    const sym3 s{random(1), random(1), random(1), random(1), random(1), random(1)};
    CHECK(largest(as<double>(turned_by(r, a)), turned_by(dense, a)) < by_rounding);
    CHECK(largest(as<double>(turned_by(r, s)), turned_by(dense, s)) < by_rounding);
  };
  for (int i = 0; i < 100; ++i) {
    check(axis::x), check(axis::y), check(axis::z);
    check(axis::minus_x), check(axis::minus_y), check(axis::minus_z);
  }
}
