#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_reader.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace mjcf_reader_test {

using namespace kte;
using test::robot_file, test::says;

constexpr double pi = 3.141592653589793;

std::string mjcf(const std::string& inside) { return "<mujoco>\n<worldbody>\n" + inside + "</worldbody></mujoco>"; }
std::string listed(const std::vector<robot_note>& notes) {
  std::string all;
  for (const auto& n : notes) all += std::to_string(n.line) + (n.changes_motion ? "! " : " ") + n.text + "\n";
  return all;
}

TEST_CASE("what a file in MJCF says") {
  const auto d = load_mjcf(robot_file("everything.xml"));
  CHECK(d.gravity == vec3<>{0, 0, -1.625});
  std::vector<std::string> links, joints;
  for (const auto& l : d.links) links.push_back(l.name);
  for (const auto& j : d.joints) joints.push_back(j.name);
  CHECK(links == std::vector<std::string>{"world", "base", "upper", "upper.1", "hand", "tool", "drone"});
  CHECK(joints == std::vector<std::string>{"shoulder", "elbow", "reach", "ball", "tool_fixed", "drone"});

  const auto& shoulder = d.joints[0];
  CHECK(shoulder.origin.rotation == mat3<vec3<>>{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}});
  CHECK(shoulder.axis == vec3<>{0, 1, 0});
  CHECK(shoulder.lower == within(-pi / 2, 0));
  CHECK(shoulder.upper == within(pi, 0));
  CHECK((shoulder.dynamics.damping == 0.5 && shoulder.dynamics.armature == 0.25 && shoulder.dynamics.friction == 0.25));
  CHECK(shoulder.child_pose.rotation == mat3<vec3<>>{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}});  // back by ref
  const auto& elbow = d.joints[1];
  CHECK((elbow.continuous && elbow.axis == vec3<>{0, 0, 1} && elbow.dynamics.armature == 0));
  CHECK((elbow.dynamics.stiffness == 3 && elbow.child == "upper.1"));
  CHECK(elbow.dynamics.rest == within(pi / 4, 0));
  CHECK(elbow.origin.position == vec3<>{0.5, -0.25, 0});
  CHECK(elbow.child_pose.position == vec3<>{0, -0.25, 0});
  const auto& reach = d.joints[2];
  CHECK((reach.is == robot_joint::kind::prismatic && reach.axis == vec3<>{0, 1, 0} && reach.upper == 0.5));
  CHECK((reach.parent == "upper.1" && reach.child == "upper"));
  CHECK((reach.dynamics.damping == 0.5 && reach.dynamics.damping_powers == robot_joint_dynamics::powers{0.25, 0.125}));
  CHECK((reach.dynamics.stiffness == 2 && reach.dynamics.stiffness_powers == robot_joint_dynamics::powers{0, 4}));
  CHECK(d.joints[3].origin.rotation == mat3<vec3<>>{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}});
  CHECK(d.joints[4].origin.rotation == mat3<vec3<>>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}});

  CHECK(d.links[1].inertial->inertia == sym3<>{2, 0, 0, 1, 0, 2.5});
  CHECK(d.links[2].inertial->inertia == sym3<>{1, 0.125, 0.25, 2, 0.5, 2.5});
  const auto& tool = *d.links[5].inertial;  // m (3 r^2 + (2 h)^2)/12, m r^2/2
  CHECK((tool.mass == 12 && tool.inertia.xx == 4.75 && tool.inertia.zz == 1.5));
  CHECK(d.links[6].inertial->inertia == sym3<>{13, 0, 0, 10, 0, 5});
  const double ball = 500 * 4 * pi / 3 * 0.001;
  CHECK(d.links[4].inertial->mass == within(1 + ball, 1e-15));
  CHECK(d.links[4].inertial->com.z == within(0.5 / (1 + ball), 1e-16));
  CHECK((d.links[1].visuals.size() == 1 && d.links[1].visuals[0].size == vec3<>{0.2, 0.4, 0.6}));
  CHECK((d.links[1].collisions.empty() && d.links[0].collisions.size() == 1));
  REQUIRE(d.actuators.size() == 2);
  CHECK((d.actuators[0].joint == "shoulder" && d.actuators[0].gear == 100 && d.actuators[1].gear == 1));
  CHECK(listed(d.not_read) ==
        "42 <sensor>: not read\n"
        "15 <light>: not read\n"
        "34 freejoint 'drone': the pose of its body is where it starts, which is not part of a chain\n"
        "4 <option>: its timestep is not read\n");
}

TEST_CASE("angles of MJCF turn with the frame, or do not, and capsules weigh") {
  const auto turned = [](const std::string& sequence) {
    return from_mjcf("<mujoco><compiler eulerseq='" + sequence + "'/>" +
                     "<worldbody><body euler='90 90 0'/></worldbody></mujoco>")
        .joints[0]
        .origin.rotation;
  };
  CHECK(turned("xyz") == mat3<vec3<>>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}});
  CHECK(turned("XYZ") == mat3<vec3<>>{{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}});
  const auto tilted = from_mjcf(mjcf("<body zaxis='0.6 0 -0.8'/>")).joints[0].origin.rotation;
  CHECK(tilted.x.z == within(0.6, 0));
  CHECK(tilted.x.x == within(-0.8, 5e-16));
  CHECK(tilted.z.x == within(-0.6, 0));
  // six tenths of it are the tube, with 1/4 + 1/3 and 1/2; four the ends, with 2/5 + 1 + 3/4 and 2/5
  const auto d = from_mjcf(mjcf("<body><geom type='capsule' size='1 1' mass='100'/></body>"));
  CHECK(d.links[1].inertial->inertia.xx == within(121, 1e-13));
  CHECK(d.links[1].inertial->inertia.zz == within(46, 1e-13));
}

TEST_CASE("a robot in MJCF moves") {
  const auto r = load_robot(robot_file("everything.xml"));
  CHECK(r.chain.gravity() == vec3<>{0, 0, -1.625});
  auto s = r.chain.make_state();
  auto q = neutral_configuration(r.chain);
  q[0] = pi / 2, q[1] = 0.3, q[2] = 0.25;  // the shoulder as it is written
  const auto hand = forward_kinematics(r.chain, s, q, "hand");
  // base: z down along x; upper: 0.5 along x of it, half turned about z; elbow: a turn about (0, 0.25) of upper
  const double c = std::cos(0.3), sn = std::sin(0.3);
  const double x = -sn * (0.25 - 0.25), y = 0.25 + c * (0.25 - 0.25);  // reach 0.25 along y brings it to the axis
  CHECK(hand.position.x == within(0, 1e-16));
  CHECK(hand.position.y == within(-y, 1e-16));
  CHECK(hand.position.z == within(0.5 - (0.5 - x), 1e-16));
  CHECK(mass_matrix(r.chain, s, q)(0, 0) > 0.25);
}

TEST_CASE("errors in MJCF name file, line and element") {
  const auto refused = [](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(from_mjcf(mjcf(inside), "a.xml"), bad_file, says("kte: a.xml:" + why));
  };
  const auto joint = [&](const std::string& attributes, const std::string& why) {
    refused("<body name='b'><joint name='j' " + attributes + "/></body>", "3: joint 'j': " + why);
  };
  joint("type='screw'", "type 'screw' is none of hinge, slide, ball, free");
  joint("axis='0 0 0'", "the axis has length 0");
  joint("range='2 1'", "the lower end 2 is above the upper 1");
  joint("range='1'", "range must have two numbers, got 1");
  joint("class='x'", "there is no default class 'x'");
  joint("damping='-1'", "damping must not be negative");
  refused("<body name='b' childclass='x'/>", "3: body 'b': there is no default class 'x'");
  refused("<body name='b'><joint/><geom type='mesh'/></body>", "3: body 'b': <geom>: has no mesh");
  refused("<body name='b'><geom shellinertia='yes' size='1'/></body>",
          "3: body 'b': <geom>: shellinertia 'yes' is none of false, true");
  refused("<body name='b'><geom type='box' size='1'/></body>", "3: body 'b': <geom>: its size must have 3 numbers");
  refused("<body name='b'><body name='c'><freejoint/></body></body>",
          "3: body 'c': <freejoint>: a free joint must be the only one of a body in the world");
}

TEST_CASE("what is not read of elements of MJCF is listed, and of defaults once, where they are written") {
  const auto d = from_mjcf(
      "<mujoco><compiler convexhull='false'/><default>\n"
      "<site group='2' looks='odd'/><geom fluidshape='ellipsoid'/><joint armature='1' kind='x'/>\n"
      "<mesh refpos='1 0 0' maxhullvert='8'/></default>\n"
      "<asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1' smoothnormal='true'><plugin/></mesh>\n"
      "<mesh name='n' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/>\n"
      "<material name='red'/><texture/><material name='blue'/></asset>\n"
      "<worldbody><body name='b' user='1'><joint name='j' frictionloss='1' solimpfriction='1' solreflimit='1'/>\n"
      "<site name='s' rgba='1 0 0 1' odd='3'/><site name='t' size='1'/><site/>\n"
      "<geom size='1'/><geom size='1'/><geom type='mesh' mesh='m'/><geom type='mesh' mesh='m' hfield='h'/>\n"
      "</body><body><freejoint name='f' user='2'/></body></worldbody>\n"
      "<equality><weld name='w' body1='b' active='false'/></equality></mujoco>");
  CHECK(listed(d.not_read) ==
        "1 <compiler>: its convexhull is not read\n"
        "7 body 'b': its user is not read\n"
        "7 joint 'j': its solimpfriction is not read\n"
        "7 joint 'j': its solreflimit is not read\n"
        "2 <joint>: its kind is not read\n"
        "8 site 's': its odd is not read\n"
        "2 <site>: its looks is not read\n"
        "8 body 'b': <site>: not read, as it has no name\n"
        "2 <geom>: its fluidshape is not read\n"
        "9 body 'b': third <geom>: its shape is without the refpos of its mesh\n"
        "9 body 'b': fourth <geom>: its shape is without the refpos of its mesh\n"
        "9 body 'b': fourth <geom>: its hfield is not read\n"
        "10 freejoint 'f': its user is not read\n"
        "11 weld 'w': not read: it is disabled\n"
        "4 mesh 'm': <plugin>: not read\n"
        "4 mesh 'm': its smoothnormal is not read\n"
        "6 material 'red': no <material> is read\n"
        "6 <texture>: no <texture> is read\n"
        "8 site 's': the appearance of sites is not read: group, rgba, size\n");
  CHECK(listed(d.warnings) ==
        "7! joint 'j': how soft its dry friction is (solreffriction, solimpfriction) is not modelled\n"
        "4! mesh 'm': its maxhullvert is not read: its mass is that of the whole hull\n");
  CHECK(listed(from_mjcf(mjcf("<body><freejoint name='f' align='true'/></body>")).warnings) ==
        "3 freejoint 'f': align is not read: the coordinates of its body are those of the body's own axes\n");
}

TEST_CASE("defaults hold until the class that wrote them ends") {
  const auto d = from_mjcf(
      "<mujoco><default><joint damping='1' armature='1'/><default class='a'><joint damping='2' damping2='0'/>"
      "<joint damping='3' stiffness='1'/><default class='b'><joint armature='' stiffness='5'/></default><default "
      "class='c'/></default><default class='d'><joint frictionloss='7'/></default></default><worldbody>"
      "<body><joint class='b'/></body><body><joint class='c'/></body><body><joint class='d'/></body><body><joint/>"
      "</body><body childclass='a'><joint/></body></worldbody><default><joint armature='9'/></default></mujoco>");
  CHECK(d.joints[0].dynamics == robot_joint_dynamics{3, 0, 5, 0, 1});  // an empty attribute leaves what holds
  CHECK(d.joints[1].dynamics == robot_joint_dynamics{3, 0, 1, 0, 1});
  CHECK(d.joints[2].dynamics == robot_joint_dynamics{1, 7, 0, 0, 1});
  CHECK(d.joints[3].dynamics == robot_joint_dynamics{1, 0, 0, 0, 9});
  CHECK(d.joints[4].dynamics == robot_joint_dynamics{3, 0, 1, 0, 1});
  // Elements share what their class gives them: copies of these defaults would have 12 GB.
  std::string many =
      "<mujoco><default><geom user='" + std::string(std::size_t{1} << 22, '1') + "'/></default><worldbody>";
  for (int i = 0; i < 3000; ++i) many += "<geom size='1'/>";
  CHECK(from_mjcf(many + "</worldbody></mujoco>").not_read.size() == 1);
}

TEST_CASE("an element of MJCF has one orientation and no more numbers than it may") {
  const auto refused = [](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(from_mjcf(mjcf(inside), "a.xml"), bad_file, says("kte: a.xml:3: " + why));
  };
  const std::string only = ": only one may give its orientation";
  refused("<body name='b' quat='1 0 0 0' euler='0 0 0'/>", "body 'b': has both quat and euler" + only);
  refused("<body name='b'><site zaxis='0 0 1' xyaxes='1 0 0 0 1 0'/></body>",
          "body 'b': <site>: has both xyaxes and zaxis" + only);
  refused("<camera axisangle='0 0 1 0' zaxis='0 0 1'/>", "<camera>: has both axisangle and zaxis" + only);
  refused("<body name='b'><inertial pos='0 0 0' mass='1' quat='1 0 0 0' fullinertia='1 1 1 0 0 0'/></body>",
          "body 'b': <inertial>: has both quat and fullinertia" + only);
  refused("<geom size='1 2 3 4'/>", "<geom>: its size must have at most 3 numbers, got 4");
  refused("<geom size='1' rgba='1 1 1 1 1'/>", "<geom>: rgba must have at most 4 numbers, got 5");
  CHECK_THROWS_MATCHES(
      from_mjcf("<mujoco>\n<default>\n<geom quat='1 0 0 0' zaxis='0 0 1'/></default></mujoco>", "a.xml"), bad_file,
      says("kte: a.xml:3: <geom>: has both quat and zaxis"));
  CHECK_NOTHROW(from_mjcf(mjcf("<body quat='' euler='0 0 90'/>")));
}

}  // namespace mjcf_reader_test
