#include <kte/static.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace driving_actuator_test {

using namespace kte;
using namespace kte::test;

// clang-format off
inline constexpr struct q_     final : coord_key<"q">         {} q;
inline constexpr struct motor_ final : input_key<"motor">     {} motor;
inline constexpr struct base_  final : frame_2D_key<"base">   {} base;
inline constexpr struct cart_  final : frame_2D_key<"cart">   {} cart;
// clang-format on

TEST_CASE("a motor adds its input to a coordinate's force") {
  auto x = trial_of(driving_actuator_gen("q", "motor"), 1);
  x.at<0>().f = 0.5;
  x.at<1>() = 2.25;
  x.doForce();
  CHECK(x.at<0>().f == 2.75);
  CHECK(x.at<1>() == 2.25);
  x.at<1>() = not_a_number;
  x.doForce();
  CHECK(std::isnan(x.at<0>().f));
  auto y = trial_of<digits50>(driving_actuator_gen("q", "motor"), 1);
  y.at<1>() = digits50(1) / 3;
  y.doForce();
  CHECK(y.at<0>().f == digits50(1) / 3);
}

TEST_CASE("a motor accelerates a cart") {
  constexpr auto c = chain(driving_actuator_gen(q, motor), prismatic_joint_2D(q, base, cart, axis::x),
                           inertia_2D(cart, point_mass(4.0)));
  auto s = make_state(c);
  s[motor] = 6.0;
  CHECK(forward_dynamics(c, s)[0] == 1.5);
  s[q].q_ddot = 1.0;
  CHECK(inverse_dynamics(c, s)[0] == -2.0);  // 4 N are needed, the motor gives 6
}

}  // namespace driving_actuator_test
