#include <kte/robots/urdf_reader.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::heavy, test::joint_text, test::robot_file, test::says, test::urdf;

TEST_CASE("what a URDF says") {
  const auto d = load_urdf(robot_file("everything.urdf"), {.quarter_turn_tolerance = 1e-6});
  CHECK(d.name == "everything");
  REQUIRE(d.links.size() == 8);
  REQUIRE(d.joints.size() == 7);
  const auto& floor = d.links[0].visuals.at(0);
  CHECK((floor.name == "floor" && floor.is == robot_shape::form::box && floor.size == vec3<>{2, 3, 0.2}));
  CHECK((floor.origin.position == vec3<>{0, 0, -0.1} && floor.material == "grey" && floor.rgba.size() == 4));
  CHECK(floor.origin.rotation == mat3<vec3<>>{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}});
  const auto& mesh = d.links[0].collisions.at(0);
  CHECK((mesh.mesh == "package://robot/floor.stl" && mesh.scale == vec3<>{1, 2, 3} && mesh.line == 11));

  const auto& elbow = d.joints[0];
  CHECK((elbow.line == 14 && elbow.continuous && elbow.parent == "upper" && elbow.child == "elbow"));
  CHECK(elbow.origin.rotation == mat3<vec3<>>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}});
  CHECK(elbow.axis == vec3<>{0, 0, 1});
  CHECK((elbow.effort == 7 && elbow.rate == 8 && elbow.upper == robot_joint::none));
  CHECK((elbow.dynamics.damping == 0.25 && elbow.dynamics.friction == 0.5));
  const auto& shoulder = d.joints[1];
  CHECK((shoulder.lower == -1 && shoulder.upper == 2 && shoulder.soft_lower == -0.5 && shoulder.soft_upper == 1.5));
  const auto half =
      from_urdf(urdf("<link name='a'/><link name='b'/>" +
                     joint_text("j", "prismatic", "a", "b", "<limit upper='1' effort='1' velocity='1'/>")));
  CHECK((half.joints[0].lower == 0 && half.joints[0].upper == 1));
  const auto& finger = d.joints[3];
  CHECK((finger.mimic && finger.mimic->joint == "lift" && finger.mimic->ratio == -2 && finger.mimic->offset == 0.01));
  CHECK(d.joints[2].axis.x == within(0.6, 2e-16));

  // about the centre of mass, x and z of the inertial frame being -z and x of the link
  const auto& body = *d.links[1].inertial;
  CHECK((body.mass == 2 && body.com == vec3<>{0.25, 0, 0}));
  CHECK(body.inertia == sym3<>{2.5, 0.5, -0.25, 2, -0.125, 2});

  const auto has = [](const std::vector<robot_note>& notes, int line, const std::string& text) {
    for (const auto& n : notes)
      if (n.line == line && n.text.find(text) != std::string::npos) return true;
    return false;
  };
  CHECK(d.not_read.size() == 5);
  CHECK(has(d.not_read, 25, "joint 'shoulder': <safety_controller>: its k_position is not read"));
  CHECK(has(d.not_read, 35, "sensor 'camera': not read"));
  CHECK(has(d.not_read, 58, "transmission 'drive': not read"));
  CHECK(has(d.not_read, 59, "<gazebo>: not read"));
  CHECK(d.warnings.size() == 2);
  CHECK(has(d.warnings, 16, "joint 'elbow': <axis>: the axis has length 2; it is taken as 1"));
  CHECK(has(d.warnings, 39, "the axis has length 5"));
  CHECK(has(load_urdf(robot_file("everything.urdf")).warnings, 16, "is 1 quarter turns but for 3.27e-07 rad"));
}

TEST_CASE("turns by any angles, and quarter turns") {
  const auto turned = [](const std::string& rpy, double tolerance) {
    const auto text =
        urdf("<link name='a'/><link name='b'/>" + joint_text("j", "fixed", "a", "b", "<origin rpy='" + rpy + "'/>"));
    return from_urdf(text, "URDF", {.quarter_turn_tolerance = tolerance}).joints[0].origin.rotation;
  };
  const mat3<vec3<>> x90{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  for (const auto* angle :
       {"1.5707963267948966", "1.570796326794897", "-4.71238898038469", "7.853981633974483", "158.65042900628455"})
    CHECK(turned(std::string(angle) + " 0 0", 1e-15) == x90);
  CHECK(turned("1.5707963 0 0", 1e-6) == x90);
  CHECK(turned("1.5707963 0 0", 1e-15).y.y != 0);
  CHECK(turned("1.5707963267948966 0 3.141592653589793", 1e-15) == mat3<vec3<>>{{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}});
  CHECK(turned("0 -1.5707963267948966 0", 1e-15) == mat3<vec3<>>{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}});
  // Rot(z, 0.3) Rot(y, 0.2) Rot(x, 0.1), evaluated with more digits
  const auto r = turned("0.1 0.2 0.3", 1e-15);
  CHECK(r.x.x == within(0.93629336358419919, 3e-16));
  CHECK(r.x.y == within(-0.27509584731824373, 3e-16));
  CHECK(r.x.z == within(0.21835066314633442, 3e-16));
  CHECK(r.y.z == within(-0.036957013524625069, 3e-16));
  CHECK(r.z.x == within(-0.19866933079506122, 3e-16));
  CHECK(r.z.y == within(0.097843395007255571, 3e-16));
}

TEST_CASE("errors in a URDF name file, line and element") {
  const auto refused = [](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(from_urdf(urdf(inside), "arm.urdf"), bad_file, says("kte: arm.urdf:" + why));
  };
  const auto joint_refused = [&](const std::string& type, const std::string& rest, const std::string& why) {
    refused("<link name='a'/><link name='b'/>\n" + joint_text("elbow", type, "a", "b", rest),
            "3: joint 'elbow': " + why);
  };
  refused("<link/>", "2: <link>: has no name");
  refused("<link name=''/>", "2: link '': its name is empty");
  refused("<link name='a'>\n<inertial>\n<mass value='1'/></inertial></link>",
          "3: link 'a': <inertial>: has no <inertia>");
  refused("<link name='a'><inertial>\n<mass/><inertia/></inertial></link>", "3: link 'a': <inertia>: has no ixx");
  refused(
      "<link name='a'><inertial>\n<mass value='-1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial></link>",
      "3: link 'a': <mass>: value must not be negative, got -1");
  refused("<link name='a'><visual/></link>", "2: link 'a': <visual>: has no <geometry>");
  refused("<joint name='elbow'/>", "2: joint 'elbow': has no <parent>");
  joint_refused("hinge", "", "type 'hinge' is none of revolute");
  joint_refused("revolute", "", "has no <limit>, which joints of type revolute need");
  joint_refused("revolute", "<limit velocity='1'/>", "<limit>: has no effort");
  joint_refused("revolute", "<limit effort='1' velocity='1' lower='2' upper='1'/>",
                "<limit>: lower 2 is above upper 1");
  joint_refused("revolute", "<limit effort='1' velocity='-1'/>", "<limit>: velocity must not be negative, got -1");
  joint_refused("revolute", "<limit effort='nan' velocity='1'/>", "<limit>: effort is not a number");
  joint_refused("continuous", "<axis xyz='0 0 0'/>", "<axis>: the axis has length 0");
  joint_refused("continuous", "<axis xyz='1 0'/>", "<axis>: xyz must have three numbers, got 2");
  joint_refused("continuous", "<axis xyz='1 0 inf'/>", "<axis>: xyz must be finite, got '1 0 inf'");
  joint_refused("continuous", "<axis xyz='1 0 z'/>", "<axis>: xyz '1 0 z' is not a list of numbers");
  joint_refused("continuous", "<origin xyz='${l} 0 0'/>", "<origin>: xyz '${l} 0 0' is an expression of xacro");
  joint_refused("continuous", "<origin/><origin/>", "<origin>: comes a second time");
  joint_refused("continuous", "<dynamics damping='-1'/>", "<dynamics>: damping must not be negative, got -1");
  joint_refused("fixed", "<mimic joint='x'/>", "<mimic>: only revolute, continuous and prismatic joints can follow");
  joint_refused("continuous", "<mimic/>", "<mimic>: has no joint");
}
