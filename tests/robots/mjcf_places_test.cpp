#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"

// Where bodies, joints and frames of MJCF stand: frames, replicates, sites, keyframes, axes of the world.

namespace mjcf_places_test {

using namespace kte;
using namespace kte::test::mjcf_texts;
using test::says;

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
  refused("<replicate count='0'/>", "count must be a whole number from 1 to 1000000");
  refused("<replicate count='2.5'/>", "count must be a whole number from 1 to 1000000");
  refused("<replicate count='1000'><replicate count='1000'><body/></replicate></replicate>",
          "more than 300000 elements");
  refused("<frame childclass='x'/>", "there is no default class 'x'");
  refused("<flexcomp name='cloth'/>", "flexcomp 'cloth': is not read: flexible bodies are not modelled");
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

}  // namespace mjcf_places_test
