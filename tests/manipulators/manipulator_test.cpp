#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/manipulators/runtime_manipulator.hpp>

#include "catch.hpp"

namespace manipulator_test {

using namespace kte;
using test::says;

constexpr struct q1_ final : coord_key<"q1"> {
} q1;
constexpr struct q2_ final : coord_key<"q2"> {
} q2;
constexpr struct ground_ final : frame_3D_key<"ground"> {
} ground;
constexpr struct upper_ final : frame_3D_key<"upper"> {
} upper;
constexpr struct elbow_ final : frame_3D_key<"elbow"> {
} elbow;
constexpr struct hand_ final : frame_3D_key<"hand"> {
} hand;
constexpr auto two = chain(revolute_joint_3D(q1, ground, upper), rigid_link_3D(upper, elbow, along_x(0.5)),
                           revolute_joint_3D(q2, elbow, hand));
runtime_chain same() {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "upper") << rigid_link_3D("upper", "elbow", along_x(0.5))
    << revolute_joint_3D("q2", "elbow", "hand");
  return c;
}
constexpr auto narrow = [] {
  auto limits = unlimited(two);
  limits.lower = {-1, -2}, limits.upper = {1, 2}, limits.rate = {3, 3};
  return limits;
}();

TEST_CASE("a manipulator is its chain, with tools and limits") {
  constexpr manipulator free_arm(two, hand);
  static_assert(free_arm.limits() == unlimited(two) && free_arm.tools().size() == 1);
  constexpr manipulator arm(two, hand, elbow, narrow);
  static_assert(arm.limits() == narrow && arm.tools()[1] == "elbow");
  const std::array q{0.3, 0.4};
  CHECK(arm.getDependentPoses(q)[1].position == forward_kinematics(arm, q, elbow).position);

  const auto c = same();
  const manipulator free_one(c, "hand");
  CHECK(free_one.limits() == unlimited(c));
  joint_limits<> limits = unlimited(c);
  limits.lower = {-1, -2};
  const manipulator both(c, {"hand", "elbow"}, limits);
  CHECK(both.limits() == limits);
  CHECK(both.tools() == std::vector<std::string>{"hand", "elbow"});
  CHECK(both.getDependentPoses(q)[1].position.x == arm.getDependentPoses(q)[1].position.x);
  CHECK(manipulator(c, std::string("hand"), limits).tools().size() == 1);
}

TEST_CASE("tools and limits that is invalid are refused") {
  const auto c = same();
  CHECK_THROWS_AS(manipulator(c, "nose"), unknown_name);
  auto limits = unlimited(c);
  limits.lower[1] = 2, limits.upper[1] = 1;
  CHECK_THROWS_MATCHES(manipulator(c, "hand", limits), bad_parameter, says("coordinate 'q2'"));
  auto wrong = narrow;
  wrong.lower[0] = 2;
  CHECK_THROWS_MATCHES((manipulator(two, hand, wrong)), bad_parameter, says("coordinate 'q1'"));
}

}  // namespace manipulator_test
