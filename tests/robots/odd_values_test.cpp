#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

// What readers accept, but say.

namespace odd_values_test {

using namespace kte;
using test::says, test::urdf;
using namespace test::mjcf_texts;

/// All notes of a file in any format, a line each.
std::string notes_of(const std::string& text, const robot_options& o = {}) {
  const auto d = describe_robot(text, "r", o);
  std::string all;
  for (const auto* list : {&d.warnings, &d.not_read})
    for (const auto& n : *list) all += std::to_string(n.line) + " " + n.text + "\n";
  return all;
}
std::string urdf_shape(const std::string& inside) {
  return "<robot name='r'>\n<link name='a'><visual>" + inside + "</visual></link></robot>";
}
std::string sdf_shape(const std::string& inside) {
  return "<sdf version='1.9'><model name='m'>\n<static>true</static><link name='a'><visual name='v'>" + inside +
         "</visual></link></model></sdf>";
}

TEST_CASE("sizes below 0, colours of other than three or four numbers, and geometries without a shape are said") {
  CHECK(notes_of(urdf_shape("<geometry><sphere radius='-1'/></geometry>")) ==
        "2 link 'a': <sphere>: one of its sizes is negative: -1\n");
  CHECK(notes_of(urdf_shape("<geometry><box size='1 -2 3'/></geometry>")) ==
        "2 link 'a': <box>: one of its sizes is negative: -2\n");
  CHECK(notes_of(urdf_shape("<geometry><box size='0 0 0'/></geometry>")).empty());
  CHECK(notes_of(urdf_shape("<geometry/>")) == "2 link 'a': <geometry>: is empty\n");
  CHECK(notes_of(
            urdf_shape("<geometry><sphere radius='1'/></geometry><material name=''><color rgba='1 0'/></material>")) ==
        "2 material '': <color>: its colour has 2 numbers, not four: it is not used\n");
  CHECK(notes_of(sdf_shape("<geometry><sphere><radius>-1</radius></sphere></geometry>"))
            .starts_with("2 visual 'v': <sphere>: one of its sizes is negative: -1\n"));
  CHECK(notes_of(sdf_shape("<geometry><sphere/></geometry><material><diffuse>1</diffuse></material>"))
            .starts_with("2 visual 'v': <diffuse>: its colour has 1 numbers, not four: it is not used\n"));
}

TEST_CASE("angles of more than a turn may be in degrees") {
  CHECK(notes_of("<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>"
                 "<child link='b'/>\n<origin rpy='90 0 0'/></joint></robot>") ==
        "2 joint 'j': <origin>: the angle 90 rad is more than a turn: is it in degrees?\n");
  const auto turned = [](const std::string& attributes) {
    return notes_of("<sdf version='1.9'><model name='m'>\n<link name='a'><inertial/><pose" + attributes +
                    ">0 0 0 0 -180 0</pose></link></model></sdf>");
  };
  CHECK(turned("").find("2 link 'a': <pose>: the angle -180 rad is more than a turn: is it in degrees?\n") !=
        std::string::npos);
  CHECK(turned(" degrees='true'").find("turn") == std::string::npos);
}

TEST_CASE("actuators of joints that are not there, and the model of a file that has one robot") {
  const auto acted = [](const std::string& actuator) {
    return notes_of("<mujoco><worldbody><body><joint name='j'/><geom size='1'/></body></worldbody>\n<actuator>" +
                    actuator + "</actuator></mujoco>");
  };
  CHECK(acted("<motor joint='j'/>").empty());
  CHECK(acted("<motor name='m' joint='nope'/>") == "2 motor 'm': there is no joint 'nope' for it: it is not read\n");
  CHECK(acted("<position joint='j' kp='1'/>").find("alone: that of joint 'j'\n") != std::string::npos);
  const std::string one = "<robot name='r'><link name='a'/></robot>";
  CHECK(notes_of(one, {.model = "r"}).empty());
  CHECK(notes_of(one, {.model = "other"}) ==
        "0 robot_options::model 'other' is not used: the file is no SDF, and has one robot, 'r'\n");
}

TEST_CASE("options that readers cannot use are refused") {
  for (const double smoothing : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_MATCHES(
        describe_robot("<robot name='r'><link name='a'/></robot>", "r", {.friction_smoothing = smoothing}),
        bad_argument,
        says("kte: robot_options::friction_smoothing must be finite and positive, got " + detail::number(smoothing)));
}

TEST_CASE("frames that are not there are named by the element that is relative to them") {
  CHECK_THROWS_MATCHES(
      describe_robot("<sdf version='1.9'><model name='m'>\n<link name='a'><pose relative_to='nope'>0 0 0 0 0 "
                     "0</pose></link></model></sdf>",
                     "m.sdf"),
      bad_file, says("kte: m.sdf:2: link 'a': there is no frame 'nope'"));
  CHECK_THROWS_MATCHES(from_sdf("<sdf version='1.9'><model name='m'>\n<include><uri>model://nope</uri></include>"
                                "</model></sdf>",
                                "m.sdf"),
                       bad_file, says("neither in the folders around '.' nor in those of"));
}

TEST_CASE("frictions without a number are refused") {
  const auto touching = [](const std::string& friction) {
    return describe_robot(
        "<mujoco><worldbody>\n<body><joint/><geom size='1' friction='" + friction + "'/></body></worldbody></mujoco>",
        "a.xml", {.contacts = {.ground = "world"}});
  };
  CHECK(touching("0.5 1").links.at(1).collisions.at(0).touch.friction == 0.5);
  CHECK_THROWS_MATCHES(touching(" "), bad_file, says("kte: a.xml:2: <geom>: its friction has no number"));
  CHECK_THROWS_MATCHES(touching("-1"), bad_file, says("friction must not be negative, got -1"));
}

TEST_CASE("bodies of MJCF are not written deeper than XML may nest in MuJoCo") {
  const auto chain_of = [](int n) {
    std::string all = "<link name='l0'/>";
    for (int i = 1; i <= n; ++i) {
      const auto own = "l" + std::to_string(i);
      all +=
          test::heavy(own) + test::joint_text("j" + std::to_string(i), "continuous", "l" + std::to_string(i - 1), own);
    }
    return describe_robot(urdf(all), "r.urdf");
  };
  const auto deepest = chain_of(496);  // mujoco, worldbody, 497 bodies and what is in the last
  const auto text = to_mjcf(deepest);
  CHECK(text.find("<body name=\"l496\">") != std::string::npos);
  CHECK_THROWS_MATCHES(to_mjcf(chain_of(497)), bad_argument,
                       says("kte: link 'l497': its body is more than 500 elements deep, which MJCF cannot say"));
  CHECK_THROWS_AS(to_mjcf(chain_of(20000)), bad_argument);
}

}  // namespace odd_values_test
