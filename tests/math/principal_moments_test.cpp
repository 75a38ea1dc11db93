#include <kte/math/principal_moments.hpp>

#include <cmath>

#include "catch.hpp"

namespace principal_moments_test {

using namespace kte;
using kte::test::within;

TEST_CASE("principal moments") {
  STATIC_REQUIRE(principal_moments({1, 0, 0, 3, 0, 2}) == std::array{3.0, 2.0, 1.0});
  STATIC_REQUIRE(principal_moments({}) == std::array{0.0, 0.0, 0.0});
  STATIC_REQUIRE(principal_moments({1, 1e-310, 0, 3, 0, 2}) == std::array{3.0, 2.0, 1.0});
  const auto check = [](const sym3<>& m, const std::array<double, 3>& expected, double scale) {
    const auto x = principal_moments(m);
    for (std::size_t i = 0; i < 3; ++i) CHECK(x[i] == within(expected[i], 16 * 0x1p-52 * scale));
  };
  // All products p: 1 + 2 p, 1 - p, 1 - p.
  check({1, 0.25, 0.25, 1, 0.25, 1}, {1.5, 0.75, 0.75}, 1.5);
  check({1, -0.5, -0.5, 1, -0.5, 1}, {1.5, 1.5, 0}, 1.5);
  check({1, 2, 0, 1, 0, 1}, {3, 1, -1}, 3);
  // Characteristic equation (2 - x)((2 - x)^2 - 2) = 0.
  const double root2 = 1.4142135623730951;
  check({2, 1, 0, 2, 1, 2}, {2 + root2, 2, 2 - root2}, 4);
  // Small products: they count where moments are equal, and by their squares where they are not.
  check({1, 1e-12, 0, 1, 0, 0.5}, {1 + 1e-12, 1 - 1e-12, 0.5}, 1);
  const double p = 0.00045, half = std::sqrt(0.25 + p * p);
  check({1, p, 0, 2, 0, 0.5}, {1.5 + half, 1.5 - half, 0.5}, 2);
  // Of any size: nothing is squared that is not a ratio.
  check({1e300, 2e300, 0, 1e300, 0, 1e300}, {3e300, 1e300, -1e300}, 3e300);
  check({1e-300, 2e-300, 0, 1e-300, 0, 1e-300}, {3e-300, 1e-300, -1e-300}, 3e-300);
  check({1, 1e-200, 0, 1e10, 1e-12, 1e-10}, {1e10, 1, 1e-10}, 1e10);
}

}  // namespace principal_moments_test
