#include <kte/dynamics/runtime.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/robots/detail/angles.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::robot_file, test::says;

TEST_CASE("robots written as URDF come back as the same numbers") {
  const auto name = GENERATE("iiwa14.urdf", "everything.urdf", "parts.urdf");
  const robot_options o{.quarter_turn_tolerance = 1e-6};
  const auto r = load_robot(robot_file(name), o);
  const auto text = to_urdf(r);
  const auto again = to_robot(from_urdf(text, "again", o), o);
  CHECK(record_of(again.chain) == record_of(r.chain));
  CHECK(again.limits == r.limits);
  CHECK(again.soft_limits == r.soft_limits);
  CHECK(text.find("\"inf\"") == text.npos);
  if (r.name != "everything" && r.name != "iiwa14") return;  // capsules come back as cylinders and balls
  CHECK(to_urdf(again) == text);
  REQUIRE(again.shapes.size() == r.shapes.size());
  for (std::size_t i = 0; i < r.shapes.size(); ++i) {
    CHECK((again.shapes[i].frame == r.shapes[i].frame && again.shapes[i].size == r.shapes[i].size));
    CHECK((again.shapes[i].origin == r.shapes[i].origin && again.shapes[i].mesh == r.shapes[i].mesh));
    CHECK((again.shapes[i].rgba == r.shapes[i].rgba && again.shapes[i].scale == r.shapes[i].scale));
  }
}

TEST_CASE("rotations come back to a few rounding errors") {
  for (const double angle : {0.1, 1.5, 1.5707963, 3.0, -2.0})
    for (const double pitch : {0.0, 0.7, 1.5707963, 1.5707926, -1.57, -1.570796326794}) {
      const auto turn = detail::rotation_of_rpy({angle, pitch, 0.5 * angle}, 0);
      kte_map_chain c;
      c << revolute_joint_3D("q", "a", "b").at(vec3<>{1, 2, 3}, turn);
      const auto d = from_urdf(to_urdf(c, "<&\">"));
      CHECK(d.name == "<&\">");
      const auto& m = d.joints.at(0).origin.rotation;
      for (const auto& [x, y] : {std::pair{m.x, turn.x}, {m.y, turn.y}, {m.z, turn.z}})
        CHECK(dot(x - y, x - y) == within(0, 4e-16 * 4e-16));
    }
}

TEST_CASE("what URDF cannot say is refused by name") {
  const auto refused = [](const auto& element, const std::string& why) {
    kte_map_chain c;
    c << revolute_joint_3D("q", "a", "b") << element;
    CHECK_THROWS_MATCHES(to_urdf(c), bad_argument, says(why));
  };
  refused(spherical_joint_3D("ball", "b", "c"), "kte: joint 'ball': it is spherical, which URDF cannot say");
  refused(screw_joint_3D("s", "b", "c", axis::z, 0.1),
          "kte: screw_joint_3D (coordinate 's', base 'b', end 'c'): it is");
  refused(spring_3D("a", "b", 0.1, 1.0), "kte: spring_3D (anchor1 'a', anchor2 'b'): it is no link");
  refused(revolute_joint_3D("q", "b", "c"), "its coordinate 'q' moves another joint too");
  kte_map_chain c;
  c << base_gen("rest") << revolute_joint_3D("q", "a", "b") << spring_gen("rest", "q", 0.0, 2.0);
  CHECK_THROWS_MATCHES(to_urdf(c), bad_argument, says("kte: joint 'q': it has a spring, which URDF cannot say"));
}
