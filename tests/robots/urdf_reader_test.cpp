#include <kte/robots/load_robot.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/robots/urdf_reader.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

namespace urdf_reader_test {

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
  for (const double tolerance : {-0.5, 0.25, std::nan("")})
    for (const auto* text : {"<robot><link name='a'/></robot>", "<mujoco><worldbody/></mujoco>",
                             "<sdf version='1.9'><model name='m'><link name='a'/></model></sdf>"})
      CHECK_THROWS_MATCHES(describe_robot(text, "r", {.quarter_turn_tolerance = tolerance}), bad_argument,
                           says("kte: robot_options::quarter_turn_tolerance must be between 0 and 0.1 rad, got " +
                                detail::number(tolerance)));
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
  refused("<link name='a'><inertial>\n<mass value='1'/><inertia/></inertial></link>",
          "3: link 'a': <inertia>: has no ixx");
  refused(
      "<link name='a'><inertial>\n<mass value='-1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial></link>",
      "3: link 'a': <mass>: value must not be negative, got -1");
  refused("<joint name='elbow'/>", "2: joint 'elbow': has no <parent>");
  joint_refused("hinge", "", "type 'hinge' is none of revolute");
  joint_refused("revolute", "<limit effort='nan' velocity='1'/>", "<limit>: effort is not a number");
  joint_refused("continuous", "<axis xyz='0 0 0'/>", "<axis>: the axis has length 0");
  joint_refused("continuous", "<axis xyz='1 0'/>", "<axis>: xyz must have three numbers, got 2");
  joint_refused("continuous", "<axis xyz='1 0 inf'/>", "<axis>: xyz must be finite, got '1 0 inf'");
  joint_refused("continuous", "<axis xyz='1 0 z'/>", "<axis>: xyz '1 0 z' is not a list of numbers");
  joint_refused("continuous", "<origin xyz='${l} 0 0'/>", "<origin>: xyz '${l} 0 0' is an expression of xacro");
  joint_refused("continuous", "<origin/><origin/>", "<origin>: occurs twice");
  joint_refused("continuous", "<dynamics damping='-1'/>", "<dynamics>: damping must not be negative, got -1");
  joint_refused("floating", "<mimic joint='x'/>", "<mimic>: only revolute, continuous, prismatic and screw joints can");
  joint_refused("universal", "<mimic joint='x'/>",
                "<mimic>: only revolute, continuous, prismatic and screw joints can");
  joint_refused("screw", "", "has no <drake:screw_thread_pitch>");
  joint_refused("continuous", "<mimic/>", "<mimic>: has no joint");
}

bool has(const std::vector<robot_note>& notes, const std::string& text, bool moves = false) {
  for (const auto& n : notes)
    if (n.text.find(text) != std::string::npos && n.changes_motion == moves) return true;
  return false;
}

TEST_CASE("omissions and duplicates in URDFs are read as intended, and reported") {
  const auto d = from_urdf(urdf(R"(<material name='red'><color rgba='1 0 0 1'/></material>
    <material name='red'><color rgba='0 1 0 1'/></material>
    <material name='red'><color rgba='1 0 0 1'/><texture filename='t.png'/></material>
    <link name='a'>
      <inertial><mass value='2'/></inertial>
      <visual><material name='red'/><material name='blue'/></visual>
      <collision><geometry><mesh filename='m.stl' scale='0.5'/></geometry></collision>
      <collision><geometry><capsule radius='1' length='3'/></geometry></collision>
      <collision><geometry><drake:ellipsoid a='1' b='2' c='3'/></geometry></collision>
      <collision><geometry><plane/></geometry></collision>
      <contact><lateral_friction value='1'/></contact> <gravity>0</gravity>
    </link>
    <link name='b'><inertial><inertia ixx='1' iyy='2' izz='3'/></inertial> <contact/> </link>)"));
  const auto& a = d.links[0];
  CHECK((a.inertial->mass == 2 && a.inertial->inertia == sym3<>{}));
  CHECK((d.links[1].inertial->mass == 0 && d.links[1].inertial->inertia == sym3<>{1, 0, 0, 2, 0, 3}));
  CHECK((a.visuals[0].is == robot_shape::form::none && a.visuals[0].material == "red"));
  CHECK(a.visuals[0].rgba == std::vector<double>{1, 0, 0, 1});
  CHECK(a.collisions[0].scale == vec3<>{0.5, 0.5, 0.5});
  CHECK((a.collisions[1].is == robot_shape::form::capsule && a.collisions[1].size == vec3<>{1, 3, 0}));
  CHECK((a.collisions[2].is == robot_shape::form::ellipsoid && a.collisions[2].size == vec3<>{1, 2, 3}));
  CHECK(a.collisions[3].is == robot_shape::form::plane);
  CHECK(has(d.warnings, "link 'a': <inertial>: has no <inertia>"));
  CHECK(has(d.warnings, "link 'b': <inertial>: has no <mass>: it has 0 kg"));
  for (const auto* product : {"ixy", "ixz", "iyz"})
    CHECK(has(d.warnings, std::string("link 'b': <inertia>: has no ") + product));
  CHECK(has(d.warnings, "link 'a': first <collision>: <mesh>: scale is one number"));
  CHECK(has(d.warnings, "link 'a': <contact>: contacts are not modelled: it is not read, as others of 2 links", true));
  CHECK(has(d.warnings, "link 'a': <gravity>: not read", true));
  CHECK(has(d.not_read, "material 'red': there is another material of this name; the first is used"));
  CHECK(has(d.not_read, "material 'red': <texture>: not read"));
  CHECK(has(d.not_read, "link 'a': <visual>: has no <geometry>"));
  CHECK(has(d.not_read, "material 'blue': occurs twice"));
}

TEST_CASE("a second inertial is not taken, and the world is ground") {
  const auto d = from_urdf(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial><inertial><mass value='5'/></inertial></link>" +
      joint_text("j", "continuous", "world", "a") + "</robot>");
  CHECK(d.links[0].inertial->mass == 1);
  CHECK(d.warnings.size() == 2);
  CHECK(to_robot(d).chain.dofs() == 1);
  CHECK(d.warnings[1].text == "joint 'j': its parent 'world' is not a link of the file: it is the ground");
}

TEST_CASE("joints of URDFs that are not as the format has them") {
  const auto read = [](const std::string& type, const std::string& rest) {
    return from_urdf(urdf("<link name='a'/><link name='b'/>" + joint_text("j", type, "a", "b", rest)));
  };
  const double none = robot_joint::none;
  auto d = read("revolute", "");
  CHECK((d.joints[0].lower == -none && d.joints[0].effort == none && !d.joints[0].continuous));
  CHECK(has(d.warnings, "joint 'j': has no <limit>, which joints of type revolute need: it has no limits"));
  CHECK(read("continuous", "").warnings.empty());
  d = read("prismatic", "<limit lower='2' upper='-1' velocity='-1'/>");
  CHECK((d.joints[0].lower == -1 && d.joints[0].upper == 2 && d.joints[0].soft_lower == -1));
  CHECK((d.joints[0].effort == none && d.joints[0].rate == none));
  CHECK(has(d.warnings, "<limit>: lower 2 is above upper -1; they are exchanged"));
  CHECK(has(d.warnings, "<limit>: velocity -1 is negative: it has no limit"));
  CHECK(has(d.warnings, "<limit>: has no effort: it has no limit"));
  d = read("revolute", "<limit effort='1' velocity='1'/>");
  CHECK((d.joints[0].lower == 0 && d.joints[0].upper == 0));
  d = read("continuous", "<axis xyz='0 1 0'/><axis xyz='0 0 1'/>");
  CHECK(d.joints[0].axis == vec3<>{0, 1, 0});
  CHECK(has(d.warnings, "<axis>: occurs twice; the first is used"));
  d = read("fixed", "<mimic joint='other'/>");
  CHECK(!d.joints[0].mimic);
  CHECK(has(d.not_read, "<mimic>: a fixed joint cannot follow another"));
  d = read("spherical", "<limit lower='1'/><axis xyz='2 0 0'/>");
  CHECK((d.joints[0].is == robot_joint::kind::spherical && d.warnings.empty()));
  CHECK(has(d.not_read, "<limit>: not read: only joints with one coordinate have limits"));
  d = read("continuous", "<dynamics D='3' damping='1'/><joint_properties friction='1'/>");
  CHECK(d.joints[0].dynamics.damping == 1);
  CHECK(has(d.warnings, "<dynamics>: its D is not read", true));
  CHECK(has(d.warnings, "<joint_properties>: not read", true));
}

TEST_CASE("a URDF that other readers accept is read, with a note on what is not") {
  const auto notes = [](const std::string& text) {
    const auto d = from_urdf(text, "a.urdf");
    return test::mjcf_texts::texts(d.warnings) + test::mjcf_texts::texts(d.not_read);
  };
  CHECK(notes("<robot name='r'><link name='a'/></robot>\nend of file\n") ==
        "robot 'r': its text after </robot> is not read\n");
  CHECK(notes("<robot name='r'><link name='a'/></robot>" + std::string("\0\0", 2)).ends_with("is not read\n"));
  CHECK(notes("<robot name='r'><link name='a'/></robot>\n<!-- end -->\n").empty());
  CHECK(notes("<?xml version='1.0'?><!DOCTYPE robot><!-- <sdf> --><robot name='r'><link name='a'/></robot>end") ==
        "robot 'r': its text after </robot> is not read\n");
  CHECK_THROWS_MATCHES(from_urdf("<!-- <robot> --><sdf/><!-- </robot> -->"), bad_file,
                       says("<sdf>: a URDF begins with <robot>"));
  CHECK_THROWS_MATCHES(from_urdf("<robot name='r'><link name='a'/></robot><robot/>"), bad_file,
                       says("an element comes after the end of the first"));
  const auto one = [&](const std::string& inside) {
    return notes("<robot name='r'><link name='a'>" + inside + "</link></robot>");
  };
  const std::string inertia = "<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>";
  CHECK(one("<inertial><mass value='1'/>" + inertia + inertia + "</inertial>") ==
        "link 'a': <inertia>: occurs twice; the first is used\n");
  CHECK(one("<visual><geometry><mesh filename='m.stl' scale='1 2 3 4'/></geometry></visual>") ==
        "link 'a': <mesh>: scale has 4 numbers; the first three are used\n");
  const auto d = from_urdf(urdf("<link name='a'/><link name='b'/>" +
                                joint_text("j", "continuous", "a", "b", "<limit effort='1' velocity='1'/>") +
                                "<transmission name='t'><joint name='j'/><actuator name='m'><mechanicalReduction>1:50"
                                "</mechanicalReduction></actuator></transmission>"));
  CHECK((d.actuators.size() == 1 && d.actuators[0].gear == 1));
  CHECK(test::has(d.not_read, "'1:50' is not one number: the reduction is taken as 1"));
  CHECK(test::has(from_urdf(urdf("<link name='a'/><link name='b'/>" +
                                 joint_text("j", "planar", "a", "b", "<dynamics damping='1 2 3'/>")))
                      .warnings,
                  "its damping of three numbers is not read: planar joints have none", true));
}

TEST_CASE("extensions of URDF are read where a robot can say them") {
  const auto d = from_urdf(urdf("<link name='a'/><link name='b'/><link name='c'/><link name='d'/>" +
                                joint_text("j", "continuous", "a", "b") + R"(
    <drake:joint name='s' type='screw'><parent link='b'/><child link='c'/><axis xyz='0 0 1'/>
      <drake:screw_thread_pitch value='6.283185307179586'/></drake:joint>
    <drake:joint name='u' type='universal'><parent link='c'/><child link='d'/></drake:joint>
    <frame name='tip' link='b' xyz='0 0 1' rpy='0 0 1.5707963267948966'/> <frame name='far' link='z'/>
    <frame name='a' link='b'/>
    <transmission name='t'><joint name='j'/>
      <actuator name='m'><drake:gear_ratio value='10'/><drake:rotor_inertia value='0.25'/></actuator></transmission>
    <transmission name='t2'><joint name='z'/><actuator name='m'><drake:rotor_inertia value='1'/></actuator></transmission>
    <gazebo reference='b'><turnGravityOff>true</turnGravityOff><mu1>1</mu1></gazebo> <gazebo><gravity>0</gravity></gazebo>
    <gazebo><turnGravityOff>false</turnGravityOff><gravity>true</gravity></gazebo> <loop_joint name='l'/>)"));
  REQUIRE(d.joints.size() == 4);
  CHECK(d.joints[0].dynamics.armature == 25);
  CHECK((d.joints[1].is == robot_joint::kind::screw && d.joints[1].pitch == 1));
  CHECK((d.joints[2].child == "d.cross" && d.joints[3].parent == "d.cross" && d.joints[3].name == "u_2"));
  CHECK((d.joints[2].axis == vec3<>{1, 0, 0} && d.joints[3].axis == vec3<>{0, 1, 0}));
  REQUIRE(d.frames.size() == 1);
  CHECK((d.frames[0].name == "tip" && d.frames[0].link == "b" && d.frames[0].origin.position == vec3<>{0, 0, 1}));
  CHECK(d.frames[0].origin.rotation == mat3<vec3<>>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}});
  CHECK(has(d.not_read, "frame 'far': not read: there is no link 'z'"));
  CHECK(has(d.not_read, "frame 'a': not read: another frame or a link has its name"));
  CHECK(has(d.warnings, "loop_joint 'l': not read", true));
  CHECK(has(d.warnings, "transmission 't2': there is no joint 'z'", true));
  CHECK(std::count_if(d.warnings.begin(), d.warnings.end(), [](const auto& n) { return n.changes_motion; }) == 4);
}

}  // namespace urdf_reader_test
