#include <kte/dynamics/runtime.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/sdf_reader.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

using namespace kte;
using test::robot_file, test::says;

TEST_CASE("what a file in SDF says") {
  const auto d = load_sdf(robot_file("everything.sdf"));
  CHECK((d.name == "everything" && d.gravity == vec3<>{0, 0, -1.625}));
  std::vector<std::string> links, joints;
  for (const auto& l : d.links) links.push_back(l.name);
  for (const auto& j : d.joints) joints.push_back(j.name);
  CHECK(links == std::vector<std::string>{"world", "trunk", "arm", "slider", "wrist", "hand", "wrist.cross"});
  CHECK(joints == std::vector<std::string>{"weld", "shoulder", "slide", "cross", "cross_2", "ball"});
  CHECK(d.links[1].inertial->inertia == sym3<>{2.5, 0.5, -0.25, 2, -0.125, 1});
  CHECK(d.links[1].visuals.at(0).size == vec3<>{1, 2, 3});
  CHECK(d.joints[0].origin == robot_pose{{0, 0, 2}, robot_pose{}.rotation});
  const auto& shoulder = d.joints[1];
  CHECK(shoulder.origin == robot_pose{{0, 0, 1}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}});
  CHECK(shoulder.child_pose == robot_pose{{0.5, 0, 0}, robot_pose{}.rotation});
  CHECK(shoulder.axis == vec3<>{0, 1, 0});  // z of the trunk
  CHECK((shoulder.lower == -1 && shoulder.upper == 2 && shoulder.effort == 30 && shoulder.rate == robot_joint::none));
  CHECK((shoulder.dynamics.damping == 0.5 && shoulder.dynamics.stiffness == 3 && shoulder.dynamics.rest == 0.25));
  CHECK((d.joints[2].lower == -robot_joint::none && d.joints[2].upper == robot_joint::none));
  CHECK(d.joints[2].origin.rotation == mat3<vec3<>>{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}});
  CHECK((d.joints[3].child == "wrist.cross" && d.joints[4].parent == "wrist.cross" && d.joints[4].upper == 1));
  CHECK((d.joints[5].origin.position == vec3<>{0, 0, 0.25} && d.joints[5].child_pose.position == vec3<>{0, 0, 0.25}));
  REQUIRE(d.not_read.size() == 1);
  CHECK((d.not_read[0].line == 43 && d.not_read[0].text == "plugin 'p': not read"));
  REQUIRE(d.warnings.size() == 1);
  CHECK((d.warnings[0].line == 31 && d.warnings[0].text.starts_with("link 'slider': has no <inertial>: it has 1 kg")));
}

TEST_CASE("a robot in SDF moves") {
  const auto r = load_robot(robot_file("everything.sdf"));
  CHECK(r.chain.dofs() == 7);
  auto s = r.chain.make_state();
  auto q = neutral_configuration(r.chain);
  const auto at = [&](const char* frame) { return forward_kinematics(r.chain, s, q, frame).position; };
  CHECK(at("hand") == vec3<>{1.5, -0.75, 3});  // y of the seat is z of the world, its z is -y
  q[0] = 1.5707963267948966;                   // about z of the trunk: the arm goes along y
  CHECK(at("arm").x == within(0, 1e-16));
  CHECK(at("arm").y == within(0.5, 1e-16));
  q[0] = 0, q[1] = 0.25;
  CHECK(at("slider") == vec3<>{1.5, 0, 2.75});  // the slider is half turned
}

TEST_CASE("errors in SDF name file, line and element") {
  const auto refused = [](const std::string& inside, const std::string& why) {
    const auto text =
        "<sdf version='1.9'>\n<model name='m'>\n<link name='a'/><link name='b'/>\n" + inside + "</model></sdf>";
    CHECK_THROWS_MATCHES(from_sdf(text, "a.sdf"), bad_file, says("kte: a.sdf:" + why));
  };
  const auto joint = [&](const std::string& type, const std::string& rest, const std::string& why) {
    refused("<joint name='j' type='" + type + "'><parent>a</parent><child>b</child>" + rest + "</joint>",
            "4: joint 'j': " + why);
  };
  refused("<joint name='j' type='fixed'/>", "4: joint 'j': has no <child>");
  refused("<link name='a'/>", "4: link 'a': there is another frame of this name");
  refused(
      "<frame name='f'><pose relative_to='g'/></frame><frame name='g'><pose relative_to='f'/></frame>"
      "<joint name='j' type='fixed'><pose relative_to='f'/><parent>a</parent><child>b</child></joint>",
      "4: frame 'f': its pose is relative to itself");
  refused("<include/>", "4: model 'm': <include>: is not read");
  joint("screw", "", "type 'screw' is none of revolute");
  joint("fixed", "<pose>1 2</pose>", "<pose>: must have six numbers, got 2");
  joint("fixed", "<pose relative_to='c'/>", "there is no frame 'c'");
  joint("revolute", "", "has no <axis>");
  joint("revolute", "<axis><xyz>0 0 0</xyz></axis>", "<xyz>: the axis has length 0");
  joint("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>2</lower><upper>1</upper></limit></axis>",
        "<limit>: lower 2 is above upper 1");
  joint("revolute", "<axis><xyz>0 0 1</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>",
        "<axis>: use_parent_model_frame is not read");
  CHECK_THROWS_MATCHES(from_sdf("<sdf/>", "a.sdf"), bad_file, says("kte: a.sdf:1: <sdf>: has no <model>"));
  CHECK_THROWS_MATCHES(from_sdf("<sdf><model/>\n<model/></sdf>", "a.sdf"), bad_file,
                       says("kte: a.sdf:2: <model>: is a second model"));
}
