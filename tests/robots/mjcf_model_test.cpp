#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>
#include <kte/runtime_chain/kte_map_chain.hpp>

#include <algorithm>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::says;

namespace {
std::string mjcf(const std::string& inside, const std::string& before = "") {
  return "<mujoco>" + before + "<worldbody>\n" + inside + "</worldbody></mujoco>";
}
robot robot_of(const std::string& text, const robot_options& options = {}) {
  return to_robot(describe_robot(text, "a.xml", options), options);
}
std::string texts(const std::vector<robot_note>& notes) {
  std::string all;
  for (const auto& n : notes) all += n.text + "\n";
  return all;
}
const std::string heavy = "<inertial pos='0 0 1' mass='2' diaginertia='1 1 1'/>";
}  // namespace

TEST_CASE("sections of MJCF that come twice are one") {
  const auto d =
      from_mjcf(mjcf("<body><joint name='a' range='-1 1'/><geom size='1'/><body><joint name='b' class='y'/>" + heavy +
                         "</body><body><joint name='c' class='z'/></body></body>",
                     "<compiler angle='radian'/><compiler eulerseq='XYZ'/>"
                     "<default class='x'><joint damping='3'/><geom density='10'/><default class='y'><joint "
                     "damping='4'/></default></default><default><joint armature='0.5'/></default>"
                     "<default class='z'><joint stiffness='1'/></default>"
                     "<option gravity='0 0 -1'/><option gravity='0 0 -2'/>"));
  CHECK(d.joints[0].upper == 1);         // radians, whatever the second compiler says
  const auto& a = d.joints[0].dynamics;  // figures of MuJoCo 2.2.2
  CHECK((a.damping == 3 && a.armature == 0.5 && a.stiffness == 1));
  CHECK((d.joints[1].dynamics.damping == 4 && d.joints[1].dynamics.armature == 0));
  CHECK((d.joints[2].dynamics.damping == 3 && d.joints[2].dynamics.stiffness == 1));
  CHECK(d.gravity == vec3<>{0, 0, -2});
  CHECK_THROWS_MATCHES(from_mjcf("<mujoco><default><default class='y'/><default class='y'/></default></mujoco>"),
                       bad_file, says("there is another default class 'y'"));
}

TEST_CASE("flags switch off gravity, passive forces and friction") {
  const auto with = [](const std::string& flag) {
    return from_mjcf(mjcf("<body gravcomp='1'><joint damping='1' stiffness='2' frictionloss='3'/>" + heavy + "</body>",
                          "<option><flag " + flag + "='disable'/></option>"));
  };
  CHECK(with("gravity").gravity == vec3<>{});
  const auto passive = with("passive");
  CHECK((passive.joints[0].dynamics == robot_joint_dynamics{0, 3, 0, 0, 0} &&
         passive.links[1].gravity_compensation == 0));
  CHECK(with("spring").joints[0].dynamics == robot_joint_dynamics{1, 3, 0, 0, 0});
  CHECK(with("damper").joints[0].dynamics == robot_joint_dynamics{0, 3, 2, 0, 0});
  CHECK(with("frictionloss").joints[0].dynamics == robot_joint_dynamics{1, 0, 2, 0, 0});
  CHECK(with("contact").links[1].gravity_compensation == 1);
}

TEST_CASE("rules of the compiler for masses, by the figures of MuJoCo 2.2.2") {
  const std::string bodies =
      "<geom type='box' size='1 1 1'/><body name='s'><geom type='box' size='.1 .1 .1' mass='2'/></body>"
      "<body name='a'><inertial pos='0 0 0' mass='0.1' diaginertia='1 2 9'/><joint name='ja'/>"
      "<body name='b'><inertial pos='0 0 1' mass='3' diaginertia='1 0.1 1'/><joint axis='0 1 0'/>"
      "<joint name='jb' axis='1 0 0' springdamper='0.5 0.7'/></body></body>";
  const auto d =
      from_mjcf(mjcf(bodies, "<compiler settotalmass='10' boundmass='1' boundinertia='0.5' balanceinertia='true'/>"));
  const auto body = [&](const std::string& name) {
    return *std::find_if(d.links.begin(), d.links.end(), [&](const auto& l) { return l.name == name; })->inertial;
  };
  CHECK(body("s").mass == within(10.0 / 3, 1e-15));
  CHECK(body("s").inertia.yy == within(2.5 / 3, 4e-16));
  CHECK(body("a").mass == within(5.0 / 3, 5e-16));
  CHECK(body("a").inertia == sym3<>{20.0 / 3, 0, 0, 20.0 / 3, 0, 20.0 / 3});
  CHECK(body("b").mass == within(5, 1e-15));
  CHECK(body("b").inertia.yy == within(2.5 / 3, 4e-16));
  CHECK_FALSE(d.links[4].inertial);  // between the two joints, no body of the file
  const auto groups =
      from_mjcf(mjcf("<body><joint/><geom size='.1' mass='1' group='1'/><geom size='.1' mass='4'/></body>",
                     "<compiler inertiagrouprange='1 2'/>"));
  CHECK(groups.links[1].inertial->mass == 1);
  CHECK_THROWS_MATCHES(from_mjcf(mjcf("", "<compiler inertiagrouprange='1'/>")), bad_file,
                       says("must have two numbers"));
}

TEST_CASE("time constants make springs and dampers of the inertia that they move") {
  // 1/I is the diagonal of M^-1, as the axes are parallel: MuJoCo 2.2.2 has the same figures
  const std::string box = "<geom type='box' size='.1 .1 .1' mass='2'/>";
  const auto r = robot_of(mjcf("<body><geom type='box' size='.1 .1 .1' density='10'/><joint armature='0.5'/><body>" +
                               box + "<joint springdamper='0.5 0.7' ref='40' pos='0 0 1' armature='1'/></body><body>" +
                               box + "<joint armature='0.5'/></body></body>"));
  auto s = r.chain.make_state();
  const auto torque = [&](double q, double v) {
    return inverse_dynamics(r.chain, s, std::vector{0.0, q, 0.0}, std::vector{0.0, v, 0.0}, std::vector(3, 0.0))[1];
  };
  CHECK(torque(0, 1) - torque(0, 0) == within(4.051983602, 1e-9));  // ten digits are given
  CHECK(torque(1, 0) - torque(0, 0) == within(8.269354289, 1e-9));

  // on and beside joints of several axes: against M^-1 itself
  const std::string spring = "springdamper='2 1' armature='0.1'";
  const auto on_ball =
      robot_of(mjcf("<body><freejoint/>" + box + "<body pos='1 0 0'><joint type='ball' pos='0 .3 0'/>" + box +
                    "<body pos='0 1 0'><joint axis='1 2 2' " + spring + "/><joint type='slide' axis='0 3 4' " + spring +
                    "/>" + box + "<body><joint axis='1 0 0'/>" + box + "</body></body></body></body><body><joint " +
                    spring + "/>" + box + "</body>"));
  auto u = on_ball.chain.make_state();
  const auto at = neutral_configuration(on_ball.chain);
  const auto n = on_ball.chain.dofs();
  REQUIRE(n == 13);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  for (const int i : {9, 10, 12}) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, i);
    const double yields = forward_dynamics(on_ball.chain, u, at, zero, unit)[i],
                 falls = forward_dynamics(on_ball.chain, u, at, zero, zero)[i],
                 rubs = inverse_dynamics(on_ball.chain, u, at, unit, zero)[i],
                 rests = inverse_dynamics(on_ball.chain, u, at, zero, zero)[i];
    CHECK((rubs - rests) * (yields - falls) == within_relative(2.0 / 2, 1e-13));  // d/I = 2/T
  }
  // and of many: M^-1 as a whole would take 200 MB, and minutes
  std::string many;
  for (int i = 0; i < 5000; ++i) many += "<body><joint springdamper='0.5 0.7'/>" + box + "</body>";
  const auto alike = robot_of(mjcf(many));
  auto v = alike.chain.make_state();
  const std::vector<double> q(5000, 0.0), one(5000, 1.0);
  const auto damping = inverse_dynamics(alike.chain, v, q, one, q);
  CHECK(damping[4999] == within_relative(2 / 0.5 * 2 * 0.04 / 6, 1e-14));  // of a cube m a^2/6
}

TEST_CASE("balls and free bodies are damped, balls have springs, and weight is borne") {
  const auto r =
      robot_of(mjcf("<body><joint name='ball' type='ball' damping='2' stiffness='3'/><geom size='.1' "
                    "mass='1'/></body><body gravcomp='0.5'><joint type='free' name='free' damping='4'/>"
                    "<inertial pos='1 0 0' mass='2' diaginertia='1 1 1'/></body>",
                    "<option gravity='0 0 -10'/>"));
  CHECK(texts(r.warnings).empty());
  auto s = r.chain.make_state();
  auto q = neutral_configuration(r.chain);
  std::vector<double> v(9), zero(9);
  v[0] = 1, v[4] = 1;  // the ball about x, the body along y
  const auto force = inverse_dynamics(r.chain, s, q, v, zero);
  CHECK(force[0] == within(2, 1e-15));
  CHECK(force[4] == within(4, 1e-15));
  CHECK(force[5] == within(10, 1e-14));   // half its weight
  CHECK(force[7] == within(-10, 1e-14));  // which acts at its centre of mass
  const double angle = 0.4;
  q[0] = std::cos(angle / 2), q[2] = std::sin(angle / 2);
  CHECK(inverse_dynamics(r.chain, s, q, zero, zero)[1] == within(3 * angle, 2e-15));

  const auto left =
      robot_of(mjcf("<body name='b'><joint name='ball' type='ball' armature='2' frictionloss='1' range='0 "
                    "90'/>" +
                    heavy + "</body>"));
  CHECK(texts(left.warnings) ==
        "joint 'ball': the range of a ball is not modelled\njoint 'ball': left out, as it has "
        "several degrees of freedom: friction armature\n");
}

TEST_CASE("frames and replicates stand where they say") {
  const auto d = from_mjcf(mjcf(
      "<frame pos='1 0 0' euler='0 0 90' childclass='k'><body name='b' pos='1 0 0'><frame pos='0 0 1' euler='90 0 0'>"
      "<joint name='j' pos='1 0 0' axis='0 0 1'/><geom type='sphere' size='1' mass='3' pos='0 0 2'/><site name='s' "
      "pos='0 1 0'/></frame></body></frame><replicate count='11' offset='0 0 1' euler='0 0 90' sep='-'><body "
      "name='leg' "
      "pos='1 0 0'><joint name='hip'/></body></replicate>",
      "<default><default class='k'><joint damping='7'/></default></default>"));
  CHECK(d.joints[0].name == "j");
  CHECK(d.joints[0].dynamics.damping == 7);
  // the body stands at (1, 1, 0), turned about z; in it the joint at (1, 0, 1), its axis along -y
  CHECK(d.joints[0].axis == vec3<>{0, -1, 0});
  CHECK(d.joints[0].origin.position == vec3<>{1, 2, 1});
  CHECK(d.joints[0].child_pose.position == vec3<>{-1, 0, -1});
  CHECK(d.links[1].inertial->com == vec3<>{0, -2, 1});
  CHECK(d.links[1].visuals[0].origin.position == vec3<>{0, -2, 1});
  CHECK(d.frames[0].origin.position == vec3<>{0, 0, 2});
  CHECK((d.joints[1].name == "hip-00" && d.joints[11].name == "hip-10" && d.joints[11].child == "leg-10"));
  CHECK(d.joints[1].origin.position == vec3<>{1, 0, 0});
  CHECK(d.joints[2].origin.position == vec3<>{0, 1, 1});
  CHECK(d.joints[4].origin.position == vec3<>{0, -1, 3});
  const auto refused = [](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(from_mjcf(mjcf(inside)), bad_file, says(why));
  };
  refused("<replicate count='0'/>", "count must be a whole number from 1");
  refused("<replicate count='2.5'/>", "count must be a whole number from 1");
  refused("<replicate count='1000'><replicate count='1000'><body/></replicate></replicate>",
          "more than 300000 elements");
  refused("<frame childclass='x'/>", "there is no default class 'x'");
  refused("<flexcomp name='cloth'/>", "flexcomp 'cloth': is not read: what it makes is flexible");
}

TEST_CASE("frames and replicates in each other") {
  const auto d =
      from_mjcf(mjcf("<frame pos='1 0 0' euler='0 0 90'><frame pos='2 0 0'><replicate count='10' offset='1 0 0' "
                     "euler='0 0 90'><replicate "
                     "count='2' offset='0 0 1' sep='_'><body name='b'><joint name='j' "
                     "damping='2'/></body></replicate></replicate></frame>"
                     "</frame>",
                     "<default><joint damping='5' armature='1'/></default>"));
  CHECK(d.joints[0].name == "j_00");
  CHECK(d.joints[19].name == "j_19");
  CHECK((d.joints[0].dynamics.damping == 2 && d.joints[0].dynamics.armature == 1));  // its own counts
  CHECK(d.joints[0].origin.position == vec3<>{1, 2, 0});
  CHECK(d.joints[3].origin.position == vec3<>{1, 3, 1});  // a step along x, which points along y
  CHECK(d.joints[4].origin.position == vec3<>{0, 3, 0});  // the next in the axes of the one before
}

TEST_CASE("sites are frames and keyframes configurations") {
  const auto r = robot_of(
      mjcf("<body name='drone'><freejoint name='drone'/>" + heavy + "<body name='arm'><joint name='q'/>" + heavy +
               "<site name='tool' pos='0 0 2' euler='90 0 0'/><site name='arm' pos='1 0 0'/><site "
               "name='rope' fromto='0 0 0 0 2 0' size='.1' type='capsule'/><site pos='1 1 1'/></body></body>",
           "<keyframe><key name='home' qpos='1 2 3 2 0 0 0 0.5'/><key qpos='0 0 0 1 0 0 0 1'/>"
           "<key name='short' qpos='1'/><key name='time' time='3'/></keyframe>"));
  auto s = r.chain.make_state();
  REQUIRE(r.configurations.size() == 2);
  CHECK((r.configurations[0].name == "home" && r.configurations[1].name == "keyframe1"));
  const auto& q = r.configurations[0].q;
  CHECK(q == std::vector<double>{1, 2, 3, 1, 0, 0, 0, 0.5});  // the quaternion of length 1
  CHECK(texts(r.warnings) == "key 'short': its qpos has 1 numbers, q of the robot 8: it is not read\n");
  const auto tool = forward_kinematics(r.chain, s, q, "tool");
  CHECK((tool.position == vec3<>{1, 2, 5} && tool.rotation.z == vec3<>{0, 1, 0}));
  CHECK(forward_kinematics(r.chain, s, q, "rope").rotation.z.z == within(0, 0));
  CHECK(forward_kinematics(r.chain, s, q, "arm.site").position.z == 3);
  CHECK(texts(r.not_read).find("site 'arm': its frame is 'arm.site', as a body has its name") != std::string::npos);
  const auto zero =
      robot_of(mjcf("<body><freejoint/>" + heavy + "</body>", "<keyframe><key qpos='1 0 0 0 0 0 0'/></keyframe>"));
  CHECK(zero.configurations[0].q == std::vector<double>{1, 0, 0, 1, 0, 0, 0});
  CHECK(texts(zero.warnings) ==
        "<key>: the quaternion of joint 'body1_joint' has length 0: it is taken as no rotation\n");
}

TEST_CASE("what moves differently is warned of first, or refused") {
  const auto text = mjcf(
      "<body name='b'><joint name='j' axis='0 0 2'/><inertial pos='0 0 0' quat='1 0 0 0' mass='1' "
      "diaginertia='1 1 3'/><geom size='1' friction='1'/><geom size='1' contype='0' conaffinity='0' "
      "friction='2'/><plugin plugin='p'/></body>",
      "<option viscosity='0.1' wind='1 0 0'/><equality><connect name='loop' body1='b' anchor='0 0 0'/><weld "
      "body1='b' active='false'/></equality><tendon><fixed name='t' stiffness='3'><joint joint='j' "
      "coef='1'/></fixed><spatial name='u'/></tendon><actuator><motor joint='j'/><general joint='j' "
      "gainprm='1'/><position name='p1' joint='j' kp='1'/><position name='p2' joint='j' kp='1'/><position "
      "name='p3' joint='j'/><position name='p4' joint='j'/><position name='p0' joint='j' dampratio='1'/><muscle "
      "name='m' joint='j'/></actuator><deformable><flex name='f'/>"
      "</deformable>");
  const auto r = robot_of(text);
  CHECK(texts(r.warnings) ==
        "body 'b': <plugin>: plugins are not modelled\n"
        "<option>: the drag of its viscosity is not modelled\n"
        "connect 'loop': this constraint is not modelled\n"
        "fixed 't': its stiffness is not modelled\n"
        "flex 'f': what is flexible is not modelled\n"
        "muscle 'm': its law is not modelled, as of others of <muscle>: 'm'\n"
        "position 'p0': its law is not modelled, as of others of <position>: 'p0'\n"
        "body 'b': <geom>: contact is not modelled: friction, solref and the like of 1 element\n"
        "position 'p1': the chain has its force, and that of any <position>, by kte::add_motors alone: 'p1', 'p2', "
        "'p3' and 1 more\n"
        "link 'b': no body can have such an inertia: its principal moment 3 is above 1 + 1 by 1 kg m^2; it is taken as "
        "published\n");
  CHECK((r.warnings[0].changes_motion && !r.warnings.back().changes_motion));
  CHECK_THROWS_MATCHES(robot_of(text, strict), bad_file,
                       says("kte: the robot '' would move differently from that of its file:\n  a.xml:2: "));
  CHECK(robot_of(mjcf("<body><joint/>" + heavy + "</body>"), strict).chain.dofs() == 1);
}

TEST_CASE("what MuJoCo does with rare combinations is done, or said") {
  const auto first = [](const std::string& inside, const std::string& before = "") {
    return from_mjcf(mjcf("<body name='b'><joint name='j'/>" + inside + "</body>", before));
  };
  const std::string own = "<inertial pos='1 2 3' mass='2' diaginertia='1 1 1'/>";
  CHECK(first(own, "<compiler inertiafromgeom='true'/>").links[1].inertial->mass == 2);  // no geom counts
  CHECK(
      first(own + "<geom size='.1' mass='5' group='3'/>", "<compiler inertiafromgeom='true' inertiagrouprange='0 1'/>")
          .links[1]
          .inertial->mass == 2);
  CHECK(first(own + "<geom size='.1' mass='5'/>", "<compiler inertiafromgeom='true'/>").links[1].inertial->mass == 5);
  // of the class and the element the form counts that comes first: euler, zaxis, xyaxes, axisangle, quat
  const auto turned =
      first("<geom type='box' size='1 2 3' axisangle='0 0 1 90'/><geom type='box' size='1 2 3' quat='1 0 0 0'/>",
            "<default><geom quat='1 1 0 0'/></default>");
  CHECK(turned.links[1].visuals[0].origin.rotation.x.y == -1);
  const auto by_class =
      first("<geom type='box' size='1 2 3' quat='1 1 0 0'/>", "<default><geom euler='0 0 90'/></default>");
  CHECK(by_class.links[1].visuals[0].origin.rotation.x.y == -1);
  CHECK(first("<geom type='capsule' size='.05'/>", "<default><geom size='.1 .2 .3'/></default>")
            .links[1]
            .visuals[0]
            .size == vec3<>{0.05, 0.4, 0});
  CHECK(first("<geom class='' size='1'/>").links.size() == 2);
  const auto warned = [&](const std::string& inside, const std::string& before) {
    return texts(first(inside, before).warnings);
  };
  CHECK(warned("<geom quat='0 0 0 0' size='1'/>", "") ==
        "body 'b': <geom>: a quaternion of length 0 is taken as no rotation\n");
  CHECK(warned("", "<default><tendon stiffness='1'/></default><tendon><spatial name='t'/></tendon>") ==
        "spatial 't': its stiffness is not modelled\n");
  const std::string loop = "<equality><weld body1='b'/></equality>";
  CHECK(warned("", "<default><equality active='false'/></default>" + loop).empty());
  CHECK(warned("", "<option><flag constraint='disable'/></option>" + loop).empty());
  CHECK(warned("<geom size='1' friction='2'/>", "<option><flag contact='disable'/></option>").empty());
  CHECK(warned(own, "<compiler fusestatic='true' settotalmass='1'/>").starts_with("<compiler>: fusestatic changes"));
  CHECK(warned("<geom size='1' contype='0' conaffinity='0'/>", "<compiler discardvisual='true'/>") ==
        "body 'b': <geom>: its mass counts, whatever discardvisual says\n");
  CHECK(warned("", "<compiler boundmass='1'/>") == "body 'b': it has no mass, and the least one at its origin\n");
  const auto dynamics = [&](const std::string& flag) {
    return first("<joint name='k' springdamper='1 2'/>" + own, "<option><flag " + flag + "='disable'/></option>");
  };
  CHECK(dynamics("spring").joints[1].dynamics.damping_ratio == robot_joint::none);
  CHECK(texts(dynamics("damper").warnings) == "joint 'k': springdamper without dampers is not modelled\n");
  CHECK(dynamics("passive").joints[1].dynamics == robot_joint_dynamics{});

  const auto refused = [&](const std::string& inside, const std::string& before, const std::string& why) {
    CHECK_THROWS_MATCHES(first(inside, before), bad_file, says(why));
  };
  refused("", "<compiler angle='Degree'/>", "angle 'Degree' is none of degree, radian");
  refused("", "<compiler inertiafromgeom='True'/>", "inertiafromgeom 'True' is none of auto, true, false");
  refused("", "<option><flag gravity='disabled'/></option>", "gravity 'disabled' is none of enable, disable");
  refused("<joint limited='True' range='0 1'/>", "", "limited 'True' is none of auto, true, false");
  refused("<geom size='-1'/>", "", "its size must not be negative, got -1");
  refused("<geom fromto='0 0 0 1 0 0' size='1'/>", "", "fromto is only for capsules");
  refused("<geom type='capsule' fromto='0 0 0 1 0 0'/>", "", "has no size");
  refused("<geom size='1e200'/>", "", "its mass is not finite");
  refused("<replicate count='1000000'/>", "", "more than 300000 elements");
}

TEST_CASE("places in axes of the world") {
  const auto d =
      from_mjcf(mjcf("<body name='a' pos='0 0 1' euler='0 0 90'><joint pos='0 0 1' axis='1 0 0'/><geom "
                     "type='capsule' fromto='0 0 1 0 0 2' size='.1' mass='1'/><body name='b' pos='0 1 2'><joint "
                     "pos='0 0 2' axis='0 1 0'/><inertial pos='0 1 3' mass='1' diaginertia='1 1 1'/></body></body>",
                     "<compiler coordinate='global'/>"));
  CHECK(d.joints[0].axis == vec3<>{0, -1, 0});
  CHECK(d.links[1].inertial->com == vec3<>{0, 0, 0.5});
  CHECK(d.joints[1].axis == vec3<>{0, 1, 0});
  CHECK(d.joints[1].origin.position == vec3<>{0, 0, 1});
  CHECK(d.joints[1].child_pose.position == vec3<>{0, 1, 0});
  CHECK(d.links[2].inertial->com == vec3<>{0, 0, 1});
  CHECK_THROWS_MATCHES(from_mjcf(mjcf("<body/>", "<compiler coordinate='global'/>")), bad_file, says("has no pos"));
}

namespace {
/// The laws of the motors of a chain, with their connections.
std::vector<element_record> motors_of(const kte_map_chain& c) {
  auto all = record_of(c).elements;
  std::erase_if(all,
                [](const element_record& e) { return e.type != "joint_motor_gen" && e.type != "joint_limit_gen"; });
  return all;
}
element_record motor(const std::string& joint, const std::string& input, const motor_law& p) {
  return {"joint_motor_gen",
          1,
          {{"coordinate", joint}, {"command", input}},
          {{"gain", {p.gain}},
           {"offset", {p.offset}},
           {"stiffness", {p.stiffness}},
           {"damping", {p.damping}},
           {"lower", {p.lower}},
           {"upper", {p.upper}},
           {"lower_command", {p.lower_command}},
           {"upper_command", {p.upper_command}}}};
}
}  // namespace

TEST_CASE("motors of MJCF: gears, gains, ranges") {
  const auto text = mjcf("<body name='b'><joint name='j' range='-1 1' actuatorfrcrange='-50 50' armature='0.5'/>" +
                             heavy + "<body name='c'><joint name='k'/>" + heavy +
                             "<body name='d'><joint name='l' type='ball'/>" + heavy + "</body></body></body>",
                         "<compiler angle='radian'/><default><position kp='100' kv='10'/></default><actuator>"
                         "<position name='k' joint='k' gear='-2' ctrlrange='-1 2' forcerange='-3 4'/>"
                         "<motor name='m' joint='j' gear='100' ctrlrange='-0.25 0.75'/><velocity joint='j' kv='5'/>"
                         "<general name='g' joint='k' gainprm='3' biastype='affine' biasprm='1 -2 -4'/>"
                         "<general name='f' joint='k' dyntype='filter' gainprm='1'/><motor name='w' joint='l'/><motor "
                         "jointinparent='k' gear='0'/>"
                         "<position name='t' tendon='t' kp='1'/></actuator>");
  auto r = robot_of(text);
  add_motors(r);
  CHECK(motors_of(r.chain) ==
        std::vector<element_record>{
            motor("j", "m", {.gain = 100, .lower = -50, .upper = 50, .lower_command = -0.25, .upper_command = 0.75}),
            motor("j", "j.motor", {.gain = 5, .damping = 5, .lower = -50, .upper = 50}),
            motor("k", "k.motor",
                  {.gain = -200,
                   .stiffness = 400,
                   .damping = 40,
                   .lower = -8,
                   .upper = 6,
                   .lower_command = -1,
                   .upper_command = 2}),
            motor("k", "g", {.gain = 3, .offset = 1, .stiffness = 2, .damping = 4})});
  REQUIRE(r.motors.size() == 4);
  CHECK((r.motors[2].input == "k.motor" && r.motors[2].joint == "k" && r.motors[2].v == 1));
  CHECK(texts(r.warnings) == (test::holding("position 't': its law is not modelled") &&
                              test::holding("actuator 'f' is left out: dyntype filter is not modelled\n") &&
                              test::holding("actuator 'w' is left out: joint 'l' has several degrees of freedom\n") &&
                              test::holding("the actuator of joint 'k' is left out: its gear is 0\n") &&
                              test::holding("joint 'j' has several motors: each has the limit of its effort\n")));
  CHECK(texts(r.not_read) == test::holding("ranges are no stops (motor_options::stop_stiffness): joint 'j'\n"));
  CHECK_THROWS_MATCHES(add_motors(r), bad_argument, says("kte: the robot '' has motors already"));
  // what was read is written, and comes back
  std::vector<robot_note> notes;
  auto again = robot_of(to_mjcf(r, {.not_written = &notes, .lossy = true, .effort_limits = true}));
  CHECK(texts(notes) == test::holding("actuator 'f': left out: dyntype filter is not modelled"));
  add_motors(again);
  CHECK(motors_of(again.chain) == motors_of(r.chain));
  CHECK(describe(r.chain, "r").actuators.at(3).law == motor_law{.gain = 3, .offset = 1, .stiffness = 2, .damping = 4});

  auto servos = robot_of(text);
  add_motors(servos, {.stiffness = 30, .damping = 3, .stop_stiffness = 1000, .stop_damping = 10});
  const auto made = motors_of(servos.chain);
  CHECK(made[0] == motor("j", "m", {.gain = 30, .stiffness = 30, .damping = 3, .lower = -25, .upper = 50}));
  CHECK(made[1] == motor("j", "j.motor", {.gain = 5, .damping = 5, .lower = -50, .upper = 50}));  // its own gains
  CHECK((made[2].type == "joint_limit_gen" && made[2].parameters[1].values[0] == 1));
}

TEST_CASE("motors of URDF: transmissions, else all joints that move by themselves") {
  using test::urdf, test::joint_text;
  const auto links = test::heavy("a") + test::heavy("b") + test::heavy("c") + test::heavy("d") + test::heavy("e");
  const auto joints = joint_text("p", "revolute", "a", "b", "<limit lower='-1' upper='1' effort='5' velocity='2'/>") +
                      joint_text("q", "continuous", "b", "c", "") +
                      joint_text("f", "continuous", "c", "d", "<mimic joint='q'/>") +
                      joint_text("z", "continuous", "d", "e", "<limit effort='0' velocity='1'/>");
  const auto read = [](const std::string& inside) { return to_robot(from_urdf(urdf(inside), "r.urdf")); };
  auto r = read(links + joints);
  add_motors(r);
  CHECK(motors_of(r.chain) ==
        std::vector<element_record>{motor("p", "p.motor", {.lower = -5, .upper = 5}), motor("q", "q.motor", {})});
  CHECK(texts(r.not_read) ==
        "joint 'z' has no motor: the limit of its effort is 0\n"
        "motors do not keep the limits of rates: joint 'p', 'z'\n"
        "ranges are no stops (motor_options::stop_stiffness): joint 'p'\n");

  const auto driven =
      links + joints +
      "<transmission name='t'><type>SimpleTransmission</type><joint name='p'><hardwareInterface>PositionJointInterface"
      "</hardwareInterface></joint><actuator name='drive'><mechanicalReduction>-50</mechanicalReduction></actuator>"
      "</transmission><transmission name='u'><joint name='f'/></transmission>"
      "<transmission name='v'><joint name='q'/><joint name='n'/></transmission>";
  r = read(driven);
  CHECK((r.actuators.size() == 3 && r.actuators[0].gear == -50));
  add_motors(r);
  CHECK(motors_of(r.chain) ==
        std::vector<element_record>{motor("p", "drive", {.lower = -5, .upper = 5}), motor("q", "q.motor", {})});
  CHECK(texts(r.not_read) == test::holding("transmission 't': its PositionJointInterface has no gains in URDF"));
  CHECK(texts(r.warnings) ==
        (test::holding("transmission 'v': couples 2 joints: each has a motor of its own instead") &&
         test::holding("transmission 'v': there is no joint 'n' of one coordinate for it") &&
         test::holding("the actuator of joint 'f' is left out: joint 'f' follows another")));
  auto again = to_robot(from_urdf(to_urdf(r)));
  add_motors(again);
  CHECK(motors_of(again.chain) == motors_of(r.chain));
  const auto refused = [&](const motor_options& o, const std::string& why) {
    auto fresh = read(links + joints);
    CHECK_THROWS_MATCHES(add_motors(fresh, o), bad_argument, says("kte: motor_options: " + why));
    CHECK(fresh.motors.empty());
  };
  refused({.stiffness = -1}, "stiffness must be finite and not negative, got -1");
  refused({.damping = 1}, "a servo of damping without a stiffness goes nowhere");
  CHECK_THROWS_MATCHES(read(links + joints +
                            "<transmission><joint name='p'/><actuator><mechanicalReduction>0"
                            "</mechanicalReduction></actuator></transmission>"),
                       bad_file, says("a gear of ratio 0 moves nothing"));
}
