#include <kte/elements/free_joint.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_friction.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace mjcf_written_bodies_test {

using namespace kte;
using test::heavy, test::holding, test::joint_text, test::robot_file, test::says, test::urdf;

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
            "the least that MuJoCo accepts"});
  // moments of no matter; what does not move may have others
  const auto odd = made(heavy("a") + body("b", 1, "ixx='1' iyy='1' izz='2.75'") +
                        joint_text("q", "continuous", "a", "b", "<axis xyz='1 0 0'/>"));
  CHECK_THROWS_MATCHES(
      to_mjcf(odd), bad_argument,
      says("kte: link 'b': the moments are not physically realizable: one is wrong by 0.75 kg m^2, which MJCF cannot"));
  CHECK(to_mjcf(odd, {.lossy = true}) == holding("diaginertia=\"1.25 1.25 2.5\""));
  CHECK(to_mjcf(made(body("a", 1, "ixx='2.75' iyy='1' izz='1'"))) ==
        (holding("diaginertia=\"2.5 1.25 1.25\"") &&
         holding("it is at rest, and gets the nearest realizable moments -->")));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.3000000001'"))) == holding("<!--"));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.30000000000000004'"))) ==
        holding("diaginertia=\"0.1 0.2 0.30000000000000004\""));
  // a rod whose moments about its own centre are known to the digits of m c^2 only
  const auto rod =
      made(heavy("a") +
           "<link name='b'><inertial><origin xyz='3 0 0'/><mass value='1'/><inertia ixx='1e-14' iyy='1e-8' "
           "izz='1.0000010000027e-8' ixy='0' ixz='0' iyz='0'/></inertial></link>" +
           joint_text("q", "continuous", "a", "b", "<axis xyz='0 0 1'/>"));
  CHECK(to_mjcf(rod) == !holding("<!--"));
  CHECK(to_mjcf(made(body("a", 1, "ixx='0.1' iyy='0.2' izz='0.3000000000000002'"))) ==
        (holding("diaginertia=\"0.10000000000000005 0.20000000000000004 0.3000000000000001\"") && !holding("<!--")));
}

TEST_CASE("what MJCF cannot say is refused by name, or listed") {
  runtime_chain c;
  c << revolute_joint_3D("q", "ground", "arm") << inertia_3D("arm", rigid_body<>{2, {}, {1, 0, 0, 1, 0, 1}})
    << free_joint_3D("trunk", "arm", "body");
  CHECK_THROWS_MATCHES(to_mjcf(c), bad_argument,
                       says("kte: joint 'trunk': it floats in a link that moves, 'arm', which MJCF cannot say"));
  runtime_chain p;
  p << free_joint_3D("trunk", "ground", "body").at(vec3<>{0, 0, 1}, robot_pose{}.rotation);
  CHECK_THROWS_MATCHES(to_mjcf(p), bad_argument,
                       says("kte: joint 'trunk': its placement is not the frame of the world"));
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
          "link 'arm': its shape 'logo' is left out: MuJoCo accepts paths of meshes, not 'package://parts/logo.dae'",
          "link 'frame': frames between joints of one body, here of 'arm', have no names in MJCF",
          "joint 'slide': the limit of its rate, 2, is left out",
          "joint 'mount': its soft limits are left out",
          "joint 'mount': the limit of its effort, 3, is left out",
          "joint 'hinge': the limit of its rate, 1, is left out",
          "joint 'hinge': the limit of its effort, 1, is left out",
          "link 'hub': it moves with a mass of 0 kg, and moments down to 0 kg m^2, which are raised to 1e-15 each, the "
          "least that MuJoCo accepts",
          "joint 'left': MuJoCo does not accept an empty range: its upper limit is the next number above 0.25",
          "joint 'left': the limit of its rate, 1, is left out",
          "joint 'left': the limit of its effort, 0, is left out",
          "link 'lever_a': frames between joints of one body, here of 'lever_b', have no names in MJCF",
          "link 'bob': its mass is written into link 'lever_b', which it is fixed to",
          "link 'lever_b': it moves with a mass of 1 kg, and moments down to 0 kg m^2, which are raised to 1e-15 each, "
          "the least that MuJoCo accepts",
          "joint 'puck': it is planar, and written as slides 'puck_x', 'puck_y' and a hinge 'puck_angle'",
          "joint 'flight': it floats in the world, in which link 'ground' rests",
          "actuator 'm': its name occurs twice, and is omitted",
          "actuator 'o': left out: 'puck' is not a joint of MJCF"});
  for (const auto& n : notes) CHECK(text == holding("<!-- not as in the robot: " + n.text + " -->\n"));
  CHECK(text == holding("<motor name=\"m\" joint=\"turn\" gear=\"2\"/>\n    <motor joint=\"slide\" "
                        "gear=\"1\"/>\n    <motor joint=\"turn\" gear=\"1\"/>\n  </actuator>"));
  notes.clear();
  (void)to_mjcf(from_urdf(urdf("<link name='world'/>" + heavy("a") + joint_text("glue", "fixed", "world", "a"))),
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
  runtime_chain f;
  f << revolute_joint_3D("q", "world", "a") << inertia_3D("a", rigid_body<>{2, {}, {1, 0, 0, 1, 0, 1}})
    << joint_friction_gen("q", {.viscous = 0.5, .coulomb = 1, .smoothing_velocity = 0.25});
  (void)to_mjcf(f, "r", {.not_written = &notes});
  CHECK(texts(notes) == std::vector<std::string>{
                            "joint 'q': a description has no rate over which friction changes its sign, here 0.25"});
  auto reversed = describe(f);
  reversed.joints[0].lower = -1, reversed.joints[0].soft_lower = -0.5;
  CHECK(to_mjcf(reversed) == holding("joint 'q': its soft limits are left out"));
  reversed.joints[0].lower = 2, reversed.joints[0].upper = 1;
  CHECK_THROWS_MATCHES(to_mjcf(reversed), bad_argument, says("kte: joint 'q': its limits 2 and 1 are not a range"));
  robot empty;
  empty.chain = f;
  CHECK_THROWS_MATCHES(to_mjcf(empty), bad_parameter, says("kte: limits: lower must have 1 numbers"));
}

}  // namespace mjcf_written_bodies_test
