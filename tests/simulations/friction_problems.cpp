#include "contact/friction_statistics.hpp"

namespace friction_problems {

using kte::test::worst_of;

TEST_CASE("Friction: 1e4 random problems of 1 to 4 points, 1e3 of 8, plates and towers", "[long]") {
  for (int n = 1; n <= 4; ++n) {
    CHECK(worst_of(
              5000, [n](auto& r) { return r.plate(n); }, 1) < 1e-10);
    CHECK(worst_of(
              5000, [n](auto& r) { return r.points(n); }, 2) < 1e-10);
  }
  CHECK(worst_of(
            1000, [](auto& r) { return r.plate(8); }, 3) < 1e-10);
  CHECK(worst_of(
            1000, [](auto& r) { return r.points(8); }, 4) < 1e-10);
  CHECK(worst_of(
            100, [](auto& r) { return r.plate(16); }, 5) < 1e-10);
  CHECK(worst_of(
            50, [](auto& r) { return r.plate(32); }, 6) < 1e-10);
  CHECK(worst_of(
            100, [](auto& r) { return r.tower(8); }, 7) < 1e-10);
  CHECK(worst_of(
            100, [](auto& r) { return r.tower(8, 1.0); }, 8) < 1e-10);
}

}  // namespace friction_problems
