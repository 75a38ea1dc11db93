#include <kte/contract/coordinate_variation.hpp>
#include <kte/elements/spring.hpp>

#include <array>

#include "catch.hpp"

namespace coordinate_variation_test {

using namespace kte;
using namespace kte::detail;

TEST_CASE("elements see coordinates and signals only, or frames") {
  using on_coordinates = decltype(spring_gen("a", "b", 0.5, 3.0).core);
  using on_frames = decltype(spring_3D("a", "b", 0.5, 3.0).core);
  STATIC_REQUIRE(is_on_coordinates<on_coordinates>);
  STATIC_REQUIRE_FALSE(is_on_coordinates<on_frames>);
  STATIC_REQUIRE(has_derivatives<on_coordinates>);
  STATIC_REQUIRE_FALSE(has_derivatives<on_frames>);
}

TEST_CASE("a coordinate that is varied has unit derivatives by itself, its rate and its acceleration") {
  const coordinate<double, double, double, double, double> c{0.5, 2.0, 3.0, 0.8, 0.6};
  const auto x = varied_coordinate<double>(c, true);
  using three = std::array<double, 3>;
  const auto derivative = [](const auto& n) { return three{n.derivative[0], n.derivative[1], n.derivative[2]}; };
  CHECK(derivative(x.q) == three{1, 0, 0});
  CHECK(derivative(x.q_dot) == three{0, 1, 0});
  CHECK(derivative(x.q_ddot) == three{0, 0, 1});
  CHECK(derivative(x.cos) == three{-0.6, 0, 0});
  CHECK(derivative(x.sin) == three{0.8, 0, 0});
  CHECK(x.q.value == 0.5);
  CHECK(x.sin.value == 0.6);
  const auto other = varied_coordinate<double>(c, false);
  CHECK(derivative(other.q) == three{});
  CHECK(derivative(other.cos) == three{});
  CHECK(other.q_ddot.value == 3);
}

}  // namespace coordinate_variation_test
