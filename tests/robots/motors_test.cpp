#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>
#include <kte/robots/motors.hpp>
#include <kte/robots/urdf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"

// Motors of robot files: actuators of MJCF, transmissions of URDF.

namespace motors_test {

using namespace kte;
using namespace kte::test::mjcf_texts;
using test::says;

/// The laws of the motors of a chain, with their connections.
std::vector<element_record> motors_of(const runtime_chain& c) {
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
  CHECK(texts(r.warnings) == (test::holding("transmission 'v': couples 2 joints: each has its own motor instead") &&
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
  refused({.damping = 1}, "a servo with damping needs a stiffness");
  CHECK_THROWS_MATCHES(read(links + joints +
                            "<transmission><joint name='p'/><actuator><mechanicalReduction>0"
                            "</mechanicalReduction></actuator></transmission>"),
                       bad_file, says("a gear ratio must not be 0"));
}

}  // namespace motors_test
