#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"

// What of MJCF becomes bodies, forces and settings of a chain.

namespace mjcf_model_test {

using namespace kte;
using namespace kte::test::mjcf_texts;
using test::says;

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

}  // namespace mjcf_model_test
