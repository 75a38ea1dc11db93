#include <kte/elements/fixed_joint.hpp>
#include <kte/runtime_chain/from_record.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace fixed_joint_test {

using namespace kte;
using namespace kte::test;

TEST_CASE("a fixed joint is a rigid link") {
  const auto same = [](const auto& joint, const auto& link) {
    STATIC_REQUIRE(std::is_same_v<decltype(joint), decltype(link)>);
    CHECK(record_of(joint.core, joint.names) == record_of(link.core, link.names));
  };
  same(fixed_joint_2D("a", "b"), rigid_link_2D("a", "b", zero3{}));
  same(fixed_joint_2D("a", "b", vec2{0.25, 0.5}), rigid_link_2D("a", "b", vec2{0.25, 0.5}));
  same(fixed_joint_2D("a", "b", along_x(0.5), rotation_by(0.5)),
       rigid_link_2D("a", "b", along_x(0.5), rotation_by(0.5)));
  same(fixed_joint_3D("a", "b"), rigid_link_3D("a", "b", zero3{}));
  same(fixed_joint_3D("a", "b", along_z(0.5)), rigid_link_3D("a", "b", along_z(0.5)));
  same(fixed_joint_3D("a", "b", along_z(0.5), quarter_turn_y), rigid_link_3D("a", "b", along_z(0.5), quarter_turn_y));
}

TEST_CASE("a fixed joint without a place moves its end as its base") {
  auto x = trial_of(fixed_joint_3D("a", "b"), 1);
  CHECK(x.output().position == x.at<0>().position);
  CHECK(x.output().rotation == x.at<0>().rotation);
  CHECK(x.output().velocity == x.at<0>().velocity);
  CHECK(x.output().acceleration == x.at<0>().acceleration);
}

TEST_CASE("a fixed joint wants a finite position") {
  CHECK(complaint([] { (void)fixed_joint_3D("a", "b", along_x(not_a_number)); }) ==
        "kte: rigid_link_3D (base 'a', end 'b'): position must be finite, got nan");
}

}  // namespace fixed_joint_test
