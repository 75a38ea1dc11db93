#include <kte/contract/closure_parameters.hpp>
#include <kte/contract/coordinate_closure.hpp>
#include <kte/elements/closures/coupled_coordinates.hpp>

#include "catch.hpp"

namespace coordinate_closure_test {

using namespace kte;
using kte::test::within;

/// r q1 sin q2 = 0, with its derivative by r.
struct arm_rise : coordinate_closure<arm_rise> {
  static constexpr auto ports = detail::coordinate_closure_ports<2>;
  static constexpr std::array<std::string_view, 1> parameter_names{"r"};
  double r = 2;

  template <class Q>
  constexpr auto value(const Q& q1, const Q& q2) const {
    return Q(r * by_parameter(0, q1, q2));
  }
  template <class Q>
  constexpr Q by_parameter(int, const Q& q1, const Q& q2) const {
    using std::sin;
    return q1 * sin(q2);
  }
};
/// A closure without derivatives by its numbers.
struct plain : coordinate_closure<plain> {};

TEST_CASE("a closure of coordinates differentiates its function") {
  const arm_rise c;
  const std::array q{1.5, 0.4}, v{0.3, -0.7};
  const double s = std::sin(0.4), k = std::cos(0.4);
  CHECK(c.residual(q) == within(2 * 1.5 * s, 1e-15));
  CHECK(c.gradient(q)[0] == within(2 * s, 1e-15));
  CHECK(c.gradient(q)[1] == within(2 * 1.5 * k, 1e-15));
  CHECK(c.curvature(q, v) == within(2 * (2 * k * 0.3 * -0.7 - 1.5 * s * 0.7 * 0.7), 1e-15));
  STATIC_REQUIRE(arm_rise::rows.count() == 1);
  STATIC_REQUIRE(arm_rise::ports[2].what == kind::loop);
  STATIC_REQUIRE(detail::coordinate_closure_ports<4>[3].role == "coordinate4");
}

TEST_CASE("a closure of coordinates acts on each by its derivative, and stores its residual") {
  const arm_rise c;
  coordinate<double, double, double, double, double> a{}, b{};
  a.q = 1.5, b.q = 0.4;
  loop_state<> loop;
  loop.torque.x = 3;
  const auto f = c.doForce(a, b, loop);
  CHECK(nth<0>(f) == within(3 * 2 * std::sin(0.4), 1e-15));
  CHECK(nth<1>(f) == within(3 * 2 * 1.5 * std::cos(0.4), 1e-15));
  c.put_residual(a, b, loop);
  CHECK(loop.ang_residual.x == within(2 * 1.5 * std::sin(0.4), 1e-15));
}

TEST_CASE("derivatives of closures by their own numbers") {
  STATIC_REQUIRE(detail::derived_by_parameters<arm_rise>);
  STATIC_REQUIRE(detail::derived_by_parameters<core::coupled_coordinates>);
  STATIC_REQUIRE(!detail::derived_by_parameters<plain>);
  const arm_rise c;
  const detail::value_by_parameter<arm_rise> by{{}, c, 0};
  const std::array q{1.5, 0.4};
  CHECK(by.residual(q) == within(1.5 * std::sin(0.4), 1e-15));
  CHECK(by.gradient(q)[0] == within(std::sin(0.4), 1e-15));
  const core::coupled_coordinates gear(2, -1, 0.3);
  CHECK(gear.by_parameter(0, 0.5, 0.7) == 0.5);
  CHECK(gear.by_parameter(1, 0.5, 0.7) == 0.7);
  CHECK(gear.by_parameter(2, 0.5, 0.7) == -1);
}

}  // namespace coordinate_closure_test
