#include <kte/elements/prismatic_joint.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace prismatic_joint_test {

using namespace kte;
using namespace kte::test;

template <class S>
void check_laws() {
  random_numbers draw(1);
  const auto check = [&](const auto& joint) {
    CHECK(testing::motion_is_derivative<S>(joint, draw) <= by_differences<S>);
    CHECK(testing::power_is_kept<S>(joint, draw) <= rounding<S>);
  };
  check(prismatic_joint_2D("q", "base", "end", axis::x));
  check(prismatic_joint_2D("q", "base", "end", axis::minus_y));
  check(prismatic_joint_2D("q", "base", "end", vec2{S(3) / 5, S(-4) / 5}));
  check(prismatic_joint_3D("q", "base", "end", axis::x));
  check(prismatic_joint_3D("q", "base", "end", axis::y));
  check(prismatic_joint_3D("q", "base", "end", axis::minus_z));
  check(prismatic_joint_3D("q", "base", "end", vec3{S(2) / 7, S(3) / 7, S(6) / 7}));
  check(prismatic_joint_3D("q", "base", "end", vec3{S(3) / 5, zero, S(4) / 5}));
}

TEST_CASE("prismatic joints obey the laws") {
  check_laws<double>();
  check_laws<digits50>();
}

TEST_CASE("sliding along a typed axis is sliding along a general axis") {
  const auto check = [](const auto& axis) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      auto typed = trial_of(prismatic_joint_3D("q", "b", "e", axis), seed);
      auto general = trial_of(prismatic_joint_3D("q", "b", "e", as<double>(axis)), seed);
      const auto &x = typed.output(), &y = general.output();
      CHECK(x.rotation == y.rotation);
      CHECK(near(x.position, y.position, rounding<double>));
      CHECK(near(x.velocity, y.velocity, rounding<double>));
      CHECK(near(x.acceleration, y.acceleration, rounding<double>));
      CHECK(x.ang_velocity == y.ang_velocity);
      CHECK(x.ang_acceleration == y.ang_acceleration);
    }
  };
  check(axis::x), check(axis::y), check(axis::z);
  check(axis::minus_x), check(axis::minus_y), check(axis::minus_z);
}

TEST_CASE("a slider on a turntable feels Coriolis and centrifugal acceleration") {
  auto x = trial_of(prismatic_joint_2D("q", "b", "e", axis::x), 1);
  x.at<0>() = {.q = 3.0, .q_dot = 5.0, .q_ddot = 0.5};
  x.at<1>() = {.ang_velocity = 2.0};
  x.doMotion();
  CHECK(x.output().velocity == vec2{5.0, 6.0});
  CHECK(x.output().acceleration == vec2{0.5 - 12.0, 20.0});
}

TEST_CASE("a prismatic joint passes the wrench on and takes the force along its axis") {
  auto x = trial_of(prismatic_joint_3D("q", "b", "e", axis::y), 2);
  x.at<0>().q = 0.5;
  x.doMotion();
  x.output().force = {1.0, -2.0, 4.0}, x.output().torque = {0.25, 3.0, -1.0};
  x.doForce();
  CHECK(x.at<0>().f == -2.0);
  CHECK(x.at<1>().force == vec3{1.0, -2.0, 4.0});
  CHECK(x.at<1>().torque == vec3{0.25 + 2.0, 3.0, -1.0 - 0.5});  // with 0.5 y x F
}

TEST_CASE("a prismatic joint keeps NaN") {
  auto x = trial_of(prismatic_joint_3D("q", "b", "e", axis::y), 3);
  x.at<0>().q_dot = not_a_number;
  x.doMotion();
  CHECK(std::isnan(x.output().velocity.y));
}

TEST_CASE("a prismatic joint wants an axis of length 1") {
  const auto what = [](const auto& axis) {
    return complaint([&] { (void)prismatic_joint_2D("x", "rail", "cart", axis); });
  };
  const std::string where =
      "kte: prismatic_joint_2D (coordinate 'x', base 'rail', end 'cart'): axis must have length 1";
  CHECK(what(vec2{0.0, 0.0}) == where + ", got 0");
  CHECK(what(vec2{0.0, -3.0}) == where + ", got 3");
  CHECK(what(vec2{not_a_number, 0.0}) == where + ", got nan");
  CHECK(what(vec2{infinity, 0.0}) == where + ", got inf");
  CHECK(what(vec2{0.6, 0.8}) == "");
  CHECK(complaint([] {
          (void)prismatic_joint_3D("x", "rail", "cart", vec3{1.0, 1.0, 0.0});
        }).find("got 1.414") != std::string::npos);
}

}  // namespace prismatic_joint_test
