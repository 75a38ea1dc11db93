#include <kte/dynamics/runtime.hpp>
#include <kte/elements/constant_force.hpp>
#include <kte/elements/fluid_drag.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_friction.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::heavy, test::holding, test::joint_text, test::robot_file, test::says, test::urdf;

namespace {
robot made(const std::string& inside) { return to_robot(from_urdf(urdf(inside), "r.urdf")); }
std::string body(const std::string& link, double mass, const std::string& moments) {
  return "<link name='" + link + "'><inertial><mass value='" + std::to_string(mass) + "'/><inertia " + moments +
         " ixy='0' ixz='0' iyz='0'/></inertial></link>\n";
}
std::vector<std::string> texts(const std::vector<robot_note>& notes) {
  std::vector<std::string> all;
  for (const auto& n : notes) all.push_back(n.text);
  return all;
}
}  // namespace

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

TEST_CASE("joints with nothing but a frame between them are those of one body in MJCF") {
  const auto several = [](const auto& second) {
    kte_map_chain c;
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
  kte_map_chain c;
  c << spherical_joint_3D("p", "a", "b") << revolute_joint_3D("q", "b", "c")
    << inertia_3D("c", rigid_body<>{1, {}, {1, 0, 0, 1, 0, 1}});
  CHECK(to_mjcf(c) == holding("<body name=\"b\">"));
  const std::string ends_of = "'><parent>b</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>";
  CHECK(behind_ball("<joint name='q' type='revolute" + ends_of) == holding("<body name=\"b\""));
  CHECK(behind_ball("<joint name='q' type='prismatic" + ends_of) ==
        (holding("<body name=\"b.joint\">\n") && holding("<joint name=\"q\" type=\"slide\"")));
}

TEST_CASE("bodies that MuJoCo would not take") {
  const auto hanging = [](const std::string& links, const std::string& joints) {
    return made(heavy("a") + links + joint_text("q", "continuous", "a", "b", "<axis xyz='1 0 0'/>") + joints);
  };
  const auto light = hanging("<link name='b'/>", "");
  CHECK_THROWS_MATCHES(to_mjcf(light), bad_argument,
                       says("kte: link 'b': it moves with a mass of 0 kg, and moments down to 0 kg m^2, which MJCF "
                            "cannot say (robot_writing::lossy: they are raised to 1e-15 each)"));
  CHECK(to_mjcf(light, {.lossy = true}) ==
        holding("<inertial pos=\"0 0 0\" mass=\"1e-15\" diaginertia=\"1e-15 1e-15 1e-15\"/>"));
  // a rotor is inertia enough, as is what it carries
  auto rotor = describe(light);
  rotor.joints[0].dynamics.armature = 1e-6;
  CHECK(to_mjcf(rotor) == holding("mass=\"1e-15\""));
  rotor.joints[0].dynamics.armature = 1e-7;
  CHECK_THROWS_AS(to_mjcf(rotor), bad_argument);
  const auto fork = [&](double mass, const std::string& moments) {
    return hanging("<link name='b'/>" + body("c", mass, moments) + body("d", mass, moments),
                   joint_text("c", "continuous", "b", "c") + joint_text("d", "continuous", "b", "d"));
  };
  CHECK(to_mjcf(fork(1, "ixx='1' iyy='1' izz='1'")) == holding("mass=\"1e-15\""));
  CHECK_THROWS_AS(to_mjcf(fork(1, "ixx='1e-7' iyy='1e-7' izz='1e-7'")), bad_argument);
  CHECK_THROWS_AS(to_mjcf(fork(0, "ixx='1' iyy='1' izz='1'")), bad_argument);
  CHECK_THROWS_AS(to_mjcf(fork(1, "ixx='1' iyy='1' izz='1e-7'")), bad_argument);
  CHECK_THROWS_AS(to_mjcf(hanging(body("b", 0, "ixx='1' iyy='1' izz='1'"), "")), bad_argument);
  const auto once = to_mjcf(fork(1, "ixx='1' iyy='1' izz='1'"));
  CHECK(to_mjcf(to_robot(from_mjcf(once))) == !holding("raised"));  // MuJoCo takes 1e-15
  // what is directly fixed to it may have the mass, otherwise it is taken from behind
  const std::string fixed = joint_text("c_fixed", "fixed", "b", "c", "<origin xyz='1 0 0'/>");
  CHECK(to_mjcf(hanging("<link name='b'/>" + heavy("c"), fixed)) ==
        holding("axis=\"1 0 0\"/>\n        <body name=\"c\" pos=\"1 0 0\">\n          <inertial"));
  std::vector<robot_note> notes;
  const std::string ball = "<visual><geometry><sphere radius='1'/></geometry></visual>";
  const auto far =
      hanging("<link name='b'>" + ball + "</link><link name='c'/>" + body("d", 2, "ixx='1' iyy='1' izz='0'"),
              fixed + joint_text("d_fixed", "fixed", "c", "d", "<origin xyz='1 0 0'/>"));
  CHECK(to_mjcf(far, {.not_written = &notes}) ==
        holding("<inertial pos=\"2 0 0\" mass=\"2\" diaginertia=\"1 1 1e-15\"/>"));
  CHECK(texts(notes) ==
        std::vector<std::string>{
            "link 'd': its mass is written into link 'b', which it is fixed to",
            "link 'b': it moves with a mass of 2 kg, and moments down to 0 kg m^2, which are raised to 1e-15 each, "
            "the least that MuJoCo takes"});
  // moments of no matter; what does not move may have others
  const auto odd = made(heavy("a") + body("b", 1, "ixx='1' iyy='1' izz='2.75'") +
                        joint_text("q", "continuous", "a", "b", "<axis xyz='1 0 0'/>"));
  CHECK_THROWS_MATCHES(
      to_mjcf(odd), bad_argument,
      says("kte: link 'b': no matter has such moments: one is wrong by 0.75 kg m^2, which MJCF cannot"));
  CHECK(to_mjcf(odd, {.lossy = true}) == holding("diaginertia=\"1.25 1.25 2.5\""));
  CHECK(
      to_mjcf(made(body("a", 1, "ixx='2.75' iyy='1' izz='1'"))) ==
      (holding("diaginertia=\"2.5 1.25 1.25\"") && holding("it is at rest, and has the nearest that matter has -->")));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.3000000001'"))) == holding("<!--"));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.30000000000000004'"))) ==
        holding("diaginertia=\"0.1 0.2 0.30000000000000004\""));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.3000000000000002'"))) ==
        (holding("diaginertia=\"0.10000000000000005 0.20000000000000004 0.3000000000000001\"") && !holding("<!--")));
}

TEST_CASE("what MJCF cannot say is refused by name, or listed") {
  kte_map_chain c;
  c << revolute_joint_3D("q", "ground", "arm") << inertia_3D("arm", rigid_body<>{2, {}, {1, 0, 0, 1, 0, 1}})
    << free_joint_3D("trunk", "arm", "body");
  CHECK_THROWS_MATCHES(to_mjcf(c), bad_argument,
                       says("kte: joint 'trunk': it floats in a link that moves, 'arm', which MJCF cannot say"));
  kte_map_chain p;
  p << free_joint_3D("trunk", "ground", "body").at(vec3<>{0, 0, 1}, robot_pose{}.rotation);
  CHECK_THROWS_MATCHES(to_mjcf(p), bad_argument, says("kte: joint 'trunk': its seat stands elsewhere than the world"));
  const std::string mimic = "<limit effort='1' velocity='1'/><mimic joint='q' multiplier='2' offset='0.5'/>";
  const auto follower = made(heavy("a") + heavy("b") + heavy("c") + joint_text("q", "continuous", "a", "b") +
                             joint_text("f", "prismatic", "b", "c", mimic));
  CHECK_THROWS_MATCHES(to_mjcf(follower), bad_argument, says("kte: joint 'f': it follows joint 'q', which MJCF"));
  CHECK(to_mjcf(follower, {.lossy = true}) == holding("<joint joint1=\"f\" joint2=\"q\" polycoef=\"0.5 2 0 0 0\"/>"));

  std::vector<robot_note> notes;
  auto r = load_robot(robot_file("parts.urdf"));
  r.limits.jerk[0] = 5, r.limits.lower[13] = -1;
  r.actuators = {{"m", 0, "turn", 2}, {"m", 0, "slide", 1}, {"", 0, "turn", 1}, {"o", 7, "puck", 1}};
  const auto text = to_mjcf(r, {.not_written = &notes});
  CHECK(
      texts(notes) ==
      std::vector<std::string>{
          "coordinate 'turn': a description has no limits of acceleration and jerk",
          "coordinate 'flight': a description has no limits of coordinates of several numbers",
          "link 'arm': its shape 'logo' is left out: MuJoCo takes paths of meshes, not 'package://parts/logo.dae'",
          "link 'frame': frames between joints of one body, here of 'arm', have no names in MJCF",
          "joint 'slide': the limit of its rate, 2, is left out",
          "joint 'mount': its soft limits are left out",
          "joint 'mount': the limit of its effort, 3, is left out",
          "joint 'hinge': the limit of its rate, 1, is left out",
          "joint 'hinge': the limit of its effort, 1, is left out",
          "link 'hub': it moves with a mass of 0 kg, and moments down to 0 kg m^2, which are raised to 1e-15 each, the "
          "least that MuJoCo takes",
          "joint 'left': MuJoCo takes no range of nothing: its upper limit is the next number above 0.25",
          "joint 'left': the limit of its rate, 1, is left out",
          "joint 'left': the limit of its effort, 0, is left out",
          "link 'lever_a': frames between joints of one body, here of 'lever_b', have no names in MJCF",
          "link 'bob': its mass is written into link 'lever_b', which it is fixed to",
          "link 'lever_b': it moves with a mass of 1 kg, and moments down to 0 kg m^2, which are raised to 1e-15 each, "
          "the least that MuJoCo takes",
          "joint 'puck': it is planar, and written as slides 'puck_x', 'puck_y' and a hinge 'puck_angle'",
          "joint 'flight': it floats in the world, in which link 'ground' rests",
          "actuator 'm': its name comes a second time, and is left out",
          "actuator 'o': left out: 'puck' is no joint of MJCF"});
  for (const auto& n : notes) CHECK(text == holding("<!-- not as in the robot: " + n.text + " -->\n"));
  CHECK(text == holding("<motor name=\"m\" joint=\"turn\" gear=\"2\"/>\n    <motor joint=\"slide\" "
                        "gear=\"1\"/>\n    <motor joint=\"turn\" gear=\"1\"/>\n  </actuator>"));
  notes.clear();
  to_mjcf(from_urdf(urdf("<link name='world'/>" + heavy("a") + joint_text("glue", "fixed", "world", "a"))),
          {.not_written = &notes});
  CHECK(texts(notes) == std::vector<std::string>{"joint 'glue': fixed joints have no names in MJCF"});
  notes.clear();
  CHECK(to_mjcf(made(heavy("a") + heavy("world") + joint_text("q", "continuous", "a", "world", "")),
                {.not_written = &notes}) == holding("<body name=\"world'\">"));
  CHECK(texts(notes) == std::vector<std::string>{"link 'world': it is called \"world'\": MuJoCo's world is at rest"});
  notes.clear();
  CHECK(to_mjcf(made(heavy("world")), {.not_written = &notes}) == (!holding("inertial")));
  CHECK(texts(notes) == std::vector<std::string>{"link 'world': its mass does not move, and is left out"});
  notes.clear();
  kte_map_chain f;
  f << revolute_joint_3D("q", "world", "a") << inertia_3D("a", rigid_body<>{2, {}, {1, 0, 0, 1, 0, 1}})
    << joint_friction_gen("q", {.viscous = 0.5, .coulomb = 1, .smoothing_velocity = 0.25});
  to_mjcf(f, "r", {.not_written = &notes});
  CHECK(texts(notes) == std::vector<std::string>{
                            "joint 'q': a description has no rate over which friction changes its sign, here 0.25"});
  auto reversed = describe(f);
  reversed.joints[0].lower = -1, reversed.joints[0].soft_lower = -0.5;
  CHECK(to_mjcf(reversed) == holding("joint 'q': its soft limits are left out"));
  reversed.joints[0].lower = 2, reversed.joints[0].upper = 1;
  CHECK_THROWS_MATCHES(to_mjcf(reversed), bad_argument, says("kte: joint 'q': its limits 2 and 1 are no range"));
  robot empty;
  empty.chain = f;
  CHECK_THROWS_MATCHES(to_mjcf(empty), bad_parameter, says("kte: limits: lower must have 1 numbers"));
}

TEST_CASE("shapes are geoms without mass in MJCF") {
  const auto text = to_mjcf(load_robot(robot_file("several.xml")));
  const auto file = load_mjcf(robot_file("several.xml"));
  const auto again = from_mjcf(text);
  for (const auto& l : file.links) {
    const auto same = [&](const auto& m) { return m.name == l.name; };
    const auto& m = *std::find_if(again.links.begin(), again.links.end(), same);
    REQUIRE(m.visuals.size() == l.visuals.size());
    CHECK(m.collisions.size() == l.collisions.size());
    for (std::size_t i = 0; i < l.visuals.size(); ++i) {
      const auto &x = l.visuals[i], &y = m.visuals[i];
      CHECK((x.name == y.name && x.is == y.is && x.size == y.size && x.origin == y.origin));
      CHECK((x.mesh.empty() ? y.mesh.empty() : std::filesystem::equivalent(x.mesh, y.mesh)));
      CHECK((x.rgba == y.rgba && x.material == y.material));
    }
  }
  robot_description d;
  d.links.reserve(2);
  auto& l = d.links.emplace_back();
  l.name = "a";
  const auto shape = [&l](robot_shape::form is, const vec3<>& size, const std::string& name = {}) -> robot_shape& {
    auto& s = l.visuals.emplace_back();
    s.is = is, s.size = size, s.name = name;
    return s;
  };
  using form = robot_shape::form;
  shape(form::box, {1, 2, 0}, "flat"), shape(form::none, {}), shape(form::plane, {}), shape(form::mesh, {});
  shape(form::sphere, {1, 0, 0}, "ball").rgba = {1, 0, 0}, shape(form::sphere, {2, 0, 0}, "ball").rgba = {1, 0};
  for (const auto* mesh : {"a.STL", "a.STL", "a.dae", "file:///a.stl", "b.obj"}) shape(form::mesh, {}).mesh = mesh;
  l.visuals[l.visuals.size() - 4].scale = {2, 2, 2};
  l.collisions.push_back(l.visuals.back());
  std::vector<robot_note> notes;
  const auto as_it_is = [](const std::string& mesh) { return mesh; };
  CHECK(to_mjcf(d, {.not_written = &notes, .mesh_path = as_it_is}) == holding(R"(
  <asset>
    <mesh name="a.STL" file="a.STL"/>
    <mesh name="a.STL'" file="a.STL" scale="2 2 2"/>
    <mesh name="b.obj" file="b.obj"/>
  </asset>
  <worldbody>
    <body name="a">
      <inertial pos="0 0 0" mass="0" diaginertia="0 0 0"/>
      <geom type="plane" size="0 0 1" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom name="ball" type="sphere" size="1" contype="0" conaffinity="0" group="2" rgba="1 0 0 1" mass="0"/>
      <geom type="sphere" size="2" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="a.STL" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="a.STL'" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="b.obj" mass="0"/>
    </body>
)"));
  CHECK(texts(notes) ==
        std::vector<std::string>{"link 'a': its shape 'flat' is left out: MuJoCo takes no size of 0",
                                 "link 'a': its shape is left out: its form is not known",
                                 "link 'a': its shape is left out: its mesh '' has no file",
                                 "link 'a': the name 'ball' of a shape comes a second time, and is left out",
                                 "link 'a': its shape is left out: MuJoCo reads stl, obj and msh, not 'a.dae'",
                                 "link 'a': its shape is left out: MuJoCo takes paths of meshes, not 'file:///a.stl'"});
  notes.clear();
  const auto only_b = [](const std::string& mesh) { return mesh == "b.obj" ? "meshes/" + mesh : std::string(); };
  CHECK(to_mjcf(d, {.not_written = &notes, .mesh_path = only_b}) ==
        (holding("<mesh name=\"b.obj\" file=\"meshes/b.obj\"/>") && !holding("STL\"")));
  CHECK(notes.size() == 8);
  notes.clear();
  CHECK(to_mjcf(d, {.not_written = &notes}) == !holding("<mesh"));
  CHECK(notes.back().text == "link 'a': its shape is left out: there is no file 'b.obj'");
  // what collides is one with what is seen if all is the same
  const auto groups = [&l, &d](const auto& change) {
    l.visuals.assign(1, {}), l.visuals[0].is = form::sphere, l.visuals[0].size = {1, 0, 0};
    l.collisions = l.visuals;
    change(l.collisions[0]);
    const auto file_text = to_mjcf(d);
    return (file_text.find("group=\"2\"") != file_text.npos) + (file_text.find("group=\"3\"") != file_text.npos);
  };
  CHECK(groups([](robot_shape&) {}) == 0);
  CHECK(groups([](robot_shape& s) { s.name = "x"; }) == 2);
  CHECK(groups([](robot_shape& s) { s.size.x = 2; }) == 2);
  CHECK(groups([](robot_shape& s) { s.is = form::plane; }) == 2);
  CHECK(groups([](robot_shape& s) { s.origin.position.x = 2; }) == 2);
  l.visuals.resize(3), l.visuals[2].is = form::plane;
  l.collisions.clear();
  CHECK(to_mjcf(d) == (!holding("inertial ")));
  d.links.emplace_back().name = "world", d.links[1].visuals = {l.visuals[2]};
  d.joints.emplace_back().name = "q", d.joints[0].parent = "world", d.joints[0].child = "a";
  d.joints[0].is = robot_joint::kind::revolute, d.joints[0].dynamics.armature = 1;
  CHECK(to_mjcf(d) == (holding("<worldbody>\n    <geom type=\"plane\"") &&
                       holding("it is a plane, which MuJoCo takes of nothing that moves")));
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

  kte_map_chain other;
  other << base_3D("g") << revolute_joint_3D("q", "g", "a", axis::z) << constant_force_3D("a", vec3<>{0, 0, 1});
  CHECK_THROWS_MATCHES(describe(other), bad_argument,
                       says("constant_force_3D (frame 'a'): it is no link, joint or body"));
  kte_map_chain screw;
  screw << base_3D("g") << screw_joint_3D("q", "g", "a", vec3<>{0, 0.6, 0.8}, 0.25) << inertia_3D("a", point_mass(1.0));
  const auto turns = describe(screw).joints[0];
  CHECK((turns.is == robot_joint::kind::screw && turns.pitch == 0.25 && turns.axis == vec3<>{0, 0.6, 0.8}));
  CHECK_THROWS_MATCHES(to_mjcf(screw), bad_argument, says("joint 'q': it is a screw, which MJCF cannot say"));
  CHECK_THROWS_MATCHES(to_urdf(screw), bad_argument, says("joint 'q': it is a screw, which URDF cannot say"));
  kte_map_chain drag;
  drag << base_3D("g") << free_joint_3D("q", "g", "a") << fluid_drag_3D("a", 1.0, 2.0);
  CHECK_THROWS_MATCHES(describe(drag), bad_argument, says("fluid_drag_3D (frame 'a'): it is no link"));
}
