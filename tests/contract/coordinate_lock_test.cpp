#include <kte/contract/coordinate_lock.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"

// What all elements share that may hold a coordinate: friction, brakes, locks.

namespace coordinate_lock_test {

using namespace kte;

struct brake : coordinate_lock {
  using coordinate_lock::direction, coordinate_lock::unless_held;
};

TEST_CASE("a coordinate is held in one mode of four") {
  STATIC_REQUIRE(brake::locks_coordinate);
  STATIC_REQUIRE(brake::holds(0, double(mode::held)));
  STATIC_REQUIRE_FALSE(brake::holds(0, double(mode::sliding)));
  STATIC_REQUIRE_FALSE(brake::holds(0, double(mode::forward)));
  STATIC_REQUIRE_FALSE(brake::holds(0, double(mode::backward)));
  STATIC_REQUIRE_FALSE(brake::holds(0, 1.5));
}

TEST_CASE("what holds has no rate of change and, while it holds, no force") {
  STATIC_REQUIRE(std::is_same_v<decltype(brake::z_dot(1.0, 2.0)), std::remove_const_t<decltype(zero)>>);
  STATIC_REQUIRE(brake::unless_held(double(mode::held), 3.0) == 0);
  STATIC_REQUIRE(brake::unless_held(double(mode::forward), 3.0) == 3);
  STATIC_REQUIRE(brake::unless_held(double(mode::sliding), -3.0) == -3);
}

TEST_CASE("sliding is by the mode, and at the start by the rate") {
  STATIC_REQUIRE(brake::direction(double(mode::forward), -5.0) == 1);
  STATIC_REQUIRE(brake::direction(double(mode::backward), 5.0) == -1);
  STATIC_REQUIRE(brake::direction(double(mode::sliding), 1e-300) == 1);
  STATIC_REQUIRE(brake::direction(double(mode::sliding), -1e-300) == -1);
  STATIC_REQUIRE(brake::direction(double(mode::sliding), 0.0) == 0);
  STATIC_REQUIRE(brake::direction(double(mode::held), 0.0) == 1);
  CHECK(std::isnan(brake::direction(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

}  // namespace coordinate_lock_test
