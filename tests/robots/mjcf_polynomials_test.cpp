#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"

namespace mjcf_polynomials_test {

using namespace kte;
using test::holding, test::says, test::within, test::within_relative;
using namespace test::mjcf_texts;

const std::string arm = mjcf(R"(
<body name="b"><inertial pos="0 0 -0.5" mass="2" diaginertia="0.25 0.25 0.0625"/>
  <joint name="hinge" axis="0 1 0" damping="0.5 0.25 0.125" stiffness="3 -2 4" springref="0.25"/>
  <body name="c" pos="0 0 -1"><inertial pos="0.25 0 0" mass="1" diaginertia="0.0625 0.125 0.125"/>
    <joint name="slide" type="slide" axis="1 0 0" damping="0 2" stiffness="-1 0 8" ref="0.5" springref="0.125"/>
    <body name="d" pos="0.5 0 0"><inertial pos="0 0.5 0" mass="0.5" diaginertia="0.125 0.0625 0.125"/>
      <joint name="timed" axis="0 0 1" damping="9 0 0.5" stiffness="9 0.25" springdamper="0.5 0.75"/>
</body></body></body>)",
                             "<compiler angle='radian'/>");

std::vector<double> accelerations(const robot& r, const std::vector<double>& q, const std::vector<double>& v) {
  auto s = r.chain.make_state();
  const auto a = forward_dynamics(r.chain, s, q, v, std::vector<double>(v.size()));
  return {a.begin(), a.end()};
}

TEST_CASE("springs and dampers of polynomials move as in MuJoCo 4.0.0") {
  const auto r = robot_of(arm);
  CHECK(r.warnings.empty());
  const auto agrees = [&](const std::vector<double>& q, const std::vector<double>& v, const std::vector<double>& a) {
    const auto here = accelerations(r, q, v);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(here[i] == within_relative(a[i], 1e-12));
  };
  agrees({0.75, 0.25, -0.5}, {-1.5, 2, 1.25}, {-10.325888265350788, -10.210861219075698, -12.33092528632451});
  agrees({-0.5, 1, 0.5}, {0.5, -3, -2}, {20.00384853826339, 28.728197401289897, 31.096947574579744});
}

TEST_CASE("lists with fewer numbers than those of their classes are completed by these, as in MuJoCo 4.0.0") {
  const auto d = from_mjcf(R"(<mujoco><default>
<joint damping="1 2 3" stiffness="7 8"/><geom size=".1 .2 .3" friction=".9 .1"/>
<general gainprm="5 6 7" biasprm="1 2 3" biastype="affine"/>
<default class="in"><joint damping="4"/><geom size=".4" friction=".5"/><general biasprm="8" gainprm="9"/>
  <default class="deep"><joint damping="5 6"/></default>
  <default class="empty"><joint damping=""/></default>
</default></default>
<worldbody><body>
  <joint name="a" class="in"/><joint name="b" class="deep" axis="1 0 0"/><joint name="c" class="in" damping=".5"/>
  <joint name="d" class="empty"/><geom class="in" type="box"/>
</body></worldbody>
<actuator><general class="in" joint="a"/><general class="in" joint="a" biasprm=".5 .25"/></actuator></mujoco>)",
                           "a.xml", {.contacts = {.ground = "world"}});
  REQUIRE(d.joints.size() == 4);
  using powers = robot_joint_dynamics::powers;
  const std::pair<double, powers> dampings[]{{4, {2, 3}}, {5, {6, 3}}, {0.5, {2, 3}}, {4, {2, 3}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& x = d.joints[i].dynamics;
    CHECK((x.damping == dampings[i].first && x.damping_powers == dampings[i].second));
    CHECK((x.stiffness == 7 && x.stiffness_powers == powers{8, 0}));
  }
  const auto& box = d.links.at(1).collisions.at(0);
  CHECK((box.size == vec3<>{0.8, 0.4, 0.6} && box.touch.friction == 0.5));
  REQUIRE(d.actuators.size() == 2);
  const auto is = [](const motor_law& x, double gain, double offset, double stiffness, double damping) {
    return x.gain == gain && x.offset == offset && x.stiffness == stiffness && x.damping == damping;
  };
  CHECK(is(d.actuators[0].law, 9, 8, -2, -3));
  CHECK(is(d.actuators[1].law, 9, 0.5, -0.25, -3));
}

TEST_CASE("polynomials of springs and dampers are written to MJCF, and URDF names what it cannot say") {
  const auto d = from_mjcf(arm, "a.xml");
  const auto again = from_mjcf(to_mjcf(d), "b.xml");
  for (std::size_t i = 0; i < d.joints.size(); ++i) CHECK(again.joints[i].dynamics == d.joints[i].dynamics);
  CHECK(again.joints[2].dynamics.time_constant == 0.5);
  const auto by_chain = accelerations(robot_of(to_mjcf(robot_of(arm))), {0.75, 0.25, -0.5}, {-1.5, 2, 1.25});
  CHECK(by_chain[0] == within_relative(-10.325888265350788, 1e-12));

  const auto text = [](const std::string& attributes) {
    return from_mjcf(mjcf("<body name='b'><joint name='j' " + attributes + "/>" + heavy + "</body>"), "a.xml");
  };
  const auto r = to_robot(text("damping='1 2 3' stiffness='-1 0 2' springref='30' frictionloss='0.5'"));
  CHECK(record_of(robot_of(to_mjcf(r)).chain) == record_of(r.chain));
  const auto refused = [&](const std::string& attributes, const std::string& why) {
    CHECK_THROWS_MATCHES(to_urdf(text(attributes)), bad_argument, says("joint 'j': " + why));
  };
  refused("stiffness='0 1'", "it has a spring, which URDF cannot say");
  refused("damping='0 0 1'", "its damping is not linear, which URDF cannot say");
  refused("springdamper='1 1'", "it has a springdamper, which URDF cannot say");
  auto no_spring = text("springdamper='1 1'");
  no_spring.joints[0].dynamics.damping_ratio = robot_joint::none;
  CHECK_THROWS_MATCHES(to_mjcf(no_spring), bad_argument, says("its springdamper has no spring, which MJCF cannot say"));
  CHECK(to_mjcf(text("type='ball' damping='1 0 2'")) == holding("damping=\"1 0 2\""));
}

TEST_CASE("polynomials with dry friction, of balls, and with disabled springs and dampers") {
  const auto described = [](const std::string& attributes, const std::string& flags = "") {
    return from_mjcf(mjcf("<body name='b'><joint name='j' " + attributes + "/>" + heavy + "</body>", flags), "a.xml");
  };
  const auto joint = [&](const std::string& attributes) { return to_robot(described(attributes)); };
  const auto torque = [](const robot& r, double q, double v) {
    auto s = r.chain.make_state();
    const auto f = [&](double rate) -> double {
      return inverse_dynamics(r.chain, s, std::vector{q}, std::vector{rate}, std::vector{0.0})[0];
    };
    return f(v) - f(0);
  };
  CHECK(torque(joint("damping='1 2 3' frictionloss='0.5'"), 0, 2) == within(2 + 8 + 24 + 0.5, 1e-12));
  CHECK(torque(joint("damping='1 2 3' frictionloss='0.5'"), 0, -2) == within(-(2 + 8 + 24 + 0.5), 1e-12));
  const auto completed = described("damping='5' stiffness='4 0'", "<default><joint damping='1 2 3'/></default>");
  CHECK(completed.joints[0].dynamics.damping_powers == robot_joint_dynamics::powers{2, 3});  // as in MuJoCo
  CHECK(completed.joints[0].dynamics.damping == 5);
  const std::string all = "damping='1 2 3' stiffness='1 2 3'";
  const auto disabled = [](const std::string& what) { return "<option><flag " + what + "='disable'/></option>"; };
  CHECK(described(all, disabled("passive")).joints[0].dynamics == robot_joint_dynamics{});
  const auto spring = described(all, disabled("damper")).joints[0].dynamics;
  CHECK((spring.damping_powers == robot_joint_dynamics::powers{} && spring.stiffness_powers.cubic == 3));
  CHECK(texts(joint("type='ball' damping='1 0 2' stiffness='1 2'").warnings) ==
        "joint 'j': left out, as it has several degrees of freedom: quadratic and cubic damping quadratic and cubic "
        "stiffness\n");
  CHECK_THROWS_MATCHES(joint("stiffness='-1 0 0'"), bad_file,
                       says("joint 'j': stiffness must not be negative, got -1"));
  CHECK_THROWS_MATCHES(joint("stiffness='1 2 3 4'"), bad_file,
                       says("joint 'j': stiffness must have one to three numbers, got 4"));
}

}  // namespace mjcf_polynomials_test
