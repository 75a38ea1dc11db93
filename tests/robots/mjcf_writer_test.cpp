#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/elements/base.hpp>
#include <kte/elements/constant_force.hpp>
#include <kte/elements/fluid_drag.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/urdf_writer.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace mjcf_writer_test {

using namespace kte;
using test::heavy, test::holding, test::joint_text, test::robot_file, test::says, test::urdf;

robot made(const std::string& inside) { return to_robot(from_urdf(urdf(inside), "r.urdf")); }

TEST_CASE("robots written as MJCF move as they did") {
  const auto name = GENERATE("iiwa14.urdf", "everything.sdf", "several.xml", "parts.urdf");
  auto d = load_robot(robot_file(name));
  for (auto* list : {&d.limits.lower, &d.limits.upper, &d.limits.effort})
    for (auto& x : *list)
      if (x == 0.25 || x == 0) x = joint_limits<>::none;  // MuJoCo takes no range of nothing
  for (std::size_t i = 0; i < d.limits.lower.size(); ++i)
    if (d.limits.lower[i] == joint_limits<>::none) d.limits.lower[i] = -joint_limits<>::none;
  d.soft_limits = d.limits;
  const auto text = to_mjcf(d, {.effort_limits = true});
  const auto again = to_robot(from_mjcf(text, "again"));
  CHECK(again.chain.gravity() == d.chain.gravity());
  REQUIRE(again.chain.dofs() == d.chain.dofs());
  // planar joints are three, of rates in the axes of the plane
  auto s = d.chain.make_state(), t = again.chain.make_state();
  const auto n = static_cast<Eigen::Index>(d.chain.dofs());
  auto q = neutral_configuration(d.chain), p = neutral_configuration(again.chain);
  Eigen::VectorXd step(n), v(n), a(n), w(n), b(n);
  for (int i = 0; i < n; ++i) step[i] = std::sin(i + 1.0), v[i] = std::cos(i + 1.0), a[i] = std::sin(2 * i);
  q = integrate(d.chain, q, step, 1.0);
  Eigen::MatrixXd same = Eigen::MatrixXd::Zero(n, n);  // rates of the other from those of this
  Eigen::VectorXd drift = Eigen::VectorXd::Zero(n);
  for (const auto& e : layout(d.chain)) {
    int found = 0;
    for (const auto& f : layout(again.chain)) {
      if (f.name == e.name + "_x") {
        const double c = std::cos(q[e.q + 2]), x = std::sin(q[e.q + 2]), turn = v[e.v + 2];
        same.block<3, 3>(f.v, e.v) << c, -x, 0, x, c, 0, 0, 0, 1;
        drift.segment<2>(f.v) << turn * (-x * v[e.v] - c * v[e.v + 1]), turn * (c * v[e.v] - x * v[e.v + 1]);
      } else if (f.name != e.name) {
        continue;
      } else {
        same.block(f.v, e.v, e.nv, e.nv).setIdentity();
      }
      p.segment(f.q, e.nq) = q.segment(e.q, e.nq), ++found;
      if (e.nv != 1) continue;
      const auto i = static_cast<std::size_t>(e.v), k = static_cast<std::size_t>(f.v);
      CHECK((again.limits.lower[k] == d.limits.lower[i] && again.limits.upper[k] == d.limits.upper[i]));
      CHECK(again.limits.effort[k] == d.limits.effort[i]);
    }
    REQUIRE(found == 1);
  }
  w = same * v, b = same * a + drift;
  const auto& there = inverse_dynamics(again.chain, t, p, w, b);
  const Eigen::VectorXd tau = same.transpose() * Eigen::Map<const Eigen::VectorXd>(&there[0], n);
  const auto& here = inverse_dynamics(d.chain, s, q, v, a);
  for (int i = 0; i < n; ++i) CHECK(here[i] == within(tau[i], 1e-13));
  for (const auto* link : {"tool", "hand", "tip", "load", "puck", "drone"})
    for (const auto& l : describe(d.chain).links) {
      if (l.name != link) continue;
      const auto x =
          forward_kinematics(d.chain, s, q, l.name).position - forward_kinematics(again.chain, t, p, l.name).position;
      CHECK(dot(x, x) == within(0, 1e-29));
    }
}

TEST_CASE("joints with only a frame between them are those of one body in MJCF") {
  const auto several = [](const auto& second) {
    runtime_chain c;
    c << revolute_joint_3D("q1", "world", "a", axis::z).at(vec3<>{1, 0, 0}, robot_pose{}.rotation) << second
      << inertia_3D("b", rigid_body<>{2, {}, {1, 0, 0, 1, 0, 1}});
    return to_mjcf(c);
  };
  const auto turned = mat3<vec3<>>{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
  CHECK(several(prismatic_joint_3D("q2", "a", "b", vec3<>{1, 0, 0}).at(vec3<>{0, 0, 0.5}, turned)) ==
        holding(R"(    <body name="b" pos="1 0 0.5" quat="0.7071067811865475 0 0 0.7071067811865475">
      <joint name="q1" type="hinge" pos="0 0 -0.5" axis="0 0 1"/>
      <joint name="q2" type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
    </body>
)"));
  // nothing in between may be seen, weigh or carry more, and a body has six degrees of freedom
  std::string chain = heavy("0"), ends;
  for (int i = 1; i < 8; ++i) {
    const auto from = std::to_string(i - 1), to = std::to_string(i);
    chain += joint_text("q" + to, "continuous", from, to, "<axis xyz='" + std::to_string(i % 3) + " 1 0'/>");
    chain += i == 7 ? heavy("7") : "<link name='" + to + "'/>";
  }
  CHECK(to_mjcf(made(chain)) == (holding("<body name=\"6\">") && holding("mass=\"1e-15\"")));
  const auto two = [](const std::string& middle) {
    return to_mjcf(made(heavy("a") + middle + heavy("c") + joint_text("1", "continuous", "a", "b") +
                        joint_text("2", "continuous", "b", "c")));
  };
  CHECK(two("<link name='b'/>") == (!holding("<body name=\"b\"")));
  const std::string ball = "><geometry><sphere radius='1'/></geometry></";
  CHECK(two("<link name='b'><visual" + ball + "visual></link>") == holding("<body name=\"b\""));
  CHECK(two("<link name='b'><collision" + ball + "collision></link>") == holding("<body name=\"b\""));
  CHECK(two(heavy("b")) == holding("<body name=\"b\""));
  // a turn behind a ball, and axes of it that stand otherwise, are of another body
  const auto behind_ball = [](const std::string& joint) {
    const std::string model =
        "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'><pose>0 0 0 0 0 1</pose>"
        "<inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia></inertial>"
        "</link><link name='c'><pose>0 0 0 0 0 1</pose></link><joint name='p' type='ball'>"
        "<pose relative_to='__model__'/><parent>a</parent><child>b</child></joint>" +
        joint + "</model></sdf>";
    return to_mjcf(to_robot(from_sdf(model)), {.lossy = true});
  };
  runtime_chain c;
  c << spherical_joint_3D("p", "a", "b") << revolute_joint_3D("q", "b", "c")
    << inertia_3D("c", rigid_body<>{1, {}, {1, 0, 0, 1, 0, 1}});
  CHECK(to_mjcf(c) == holding("<body name=\"b\">"));
  const std::string ends_of = "'><parent>b</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>";
  CHECK(behind_ball("<joint name='q' type='revolute" + ends_of) == holding("<body name=\"b\""));
  CHECK(behind_ball("<joint name='q' type='prismatic" + ends_of) ==
        (holding("<body name=\"b.joint\">\n") && holding("<joint name=\"q\" type=\"slide\"")));
}

TEST_CASE("joints of descriptions whose child stands elsewhere, and poses that float") {
  auto d = from_urdf(urdf(heavy("a") + heavy("b") + joint_text("q", "continuous", "a", "b")));
  d.joints[0].child_pose.position = {0, 0, 1};
  CHECK(to_mjcf(d) == holding("<body name=\"b\" pos=\"0 0 1\">\n        <joint name=\"q\" type=\"hinge\" "
                              "pos=\"0 0 -1\" axis=\"1 0 0\"/>"));
  d.joints[0].is = robot_joint::kind::floating, d.joints[0].dynamics.damping = 2;
  CHECK(to_mjcf(d) == holding("    <body name=\"b.joint\">\n      <joint name=\"q\" type=\"free\" "
                              "damping=\"2\"/>\n      <body name=\"b\" pos=\"0 0 1\">"));
  d.joints[0].child_pose = {};
  d.joints[0].parent = "c", d.joints[0].origin.position = {0, 0, -1};  // back at the origin of the world
  d.links.emplace_back().name = "c";
  d.joints.emplace_back().name = "c_fixed", d.joints[1].origin.position = {0, 0, 1};
  d.joints[1].parent = "a", d.joints[1].child = "c";
  CHECK(to_mjcf(d) == holding("\n    <body name=\"b\">\n      <joint name=\"q\" type=\"free\""));
  d.joints[0].is = robot_joint::kind::planar;
  CHECK(to_mjcf(d) == holding("<!-- not as in the robot: joint 'q': damping, friction, springs and rotors "
                              "are only those of one coordinate -->"));
}

TEST_CASE("springs and dampers of balls, damping of free bodies and forces against weights come back from chains") {
  const auto text = [](const std::string& more) {
    return "<mujoco><worldbody><body name='b'><joint name='ball' type='ball' pos='0 0 1' damping='2' stiffness='3'/>"
           "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body><body name='f'" +
           more +
           "><joint name='free' type='free' damping='4'/><inertial pos='1 0 0' mass='2' diaginertia='1 1 1'/></body>"
           "</worldbody></mujoco>";
  };
  const auto r = to_robot(from_mjcf(text("")));
  const auto d = describe(r);
  const auto joint = [&](const std::string& name) {
    return *std::find_if(d.joints.begin(), d.joints.end(), [&](const auto& j) { return j.name == name; });
  };
  CHECK((joint("ball").dynamics == robot_joint_dynamics{2, 0, 3, 0, 0}));
  CHECK((joint("free").dynamics == robot_joint_dynamics{4, 0, 0, 0, 0}));
  CHECK(to_mjcf(r) == holding("type=\"ball\" pos=\"0 0 1\" damping=\"2\" stiffness=\"3\""));
  CHECK(record_of(to_robot(from_mjcf(to_mjcf(r))).chain) == record_of(r.chain));

  const auto borne = to_robot(from_mjcf(text(" gravcomp='0.5'")));
  for (const auto& l : describe(borne).links) CHECK(l.gravity_compensation == (l.name == "f" ? 0.5 : 0));
  CHECK_THROWS_MATCHES(to_mjcf(borne), bad_argument, says("link 'f': a force bears a part of its weight, which MJCF"));
  std::vector<robot_note> notes;
  CHECK(to_mjcf(borne, {.not_written = &notes, .lossy = true}) == !holding("gravcomp=\""));
  CHECK(notes.size() == 1);

  runtime_chain other;
  other << base_3D("g") << revolute_joint_3D("q", "g", "a", axis::z) << constant_force_3D("a", vec3<>{0, 0, 1});
  CHECK_THROWS_MATCHES(describe(other), bad_argument,
                       says("constant_force_3D (frame 'a'): it is not a link, joint, body or closure"));
  runtime_chain screw;
  screw << base_3D("g") << screw_joint_3D("q", "g", "a", vec3<>{0, 0.6, 0.8}, 0.25) << inertia_3D("a", point_mass(1.0));
  const auto turns = describe(screw).joints[0];
  CHECK((turns.is == robot_joint::kind::screw && turns.pitch == 0.25 && turns.axis == vec3<>{0, 0.6, 0.8}));
  CHECK_THROWS_MATCHES(to_mjcf(screw), bad_argument, says("joint 'q': it is a screw, which MJCF cannot say"));
  CHECK_THROWS_MATCHES(to_urdf(screw), bad_argument, says("joint 'q': it is a screw, which URDF cannot say"));
  runtime_chain drag;
  drag << base_3D("g") << free_joint_3D("q", "g", "a") << fluid_drag_3D("a", 1.0, 2.0);
  CHECK_THROWS_MATCHES(describe(drag), bad_argument, says("fluid_drag_3D (frame 'a'): it is not a link"));
}

}  // namespace mjcf_writer_test
