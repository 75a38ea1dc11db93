#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/sdf_texts.hpp"

namespace sdf_reader_test {

using namespace kte;
using test::sdf, test::model, test::link_text, test::joint, test::has, test::turned, test::robot_file, test::says;

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
  CHECK(d.not_read.empty());
  REQUIRE(d.warnings.size() == 5);
  CHECK((d.warnings[1].line == 31 && d.warnings[1].text.starts_with("link 'slider': has no <inertial>: it has 1 kg")));
  CHECK((d.warnings[4].line == 43 && d.warnings[4].text == "plugin 'p': plugins are not read: 'p'"));
  REQUIRE(d.frames.size() == 1);
  CHECK((d.frames[0].name == "mount" && d.frames[0].link == "trunk" && d.frames[0].origin.position.z == 1));
}

TEST_CASE("a robot in SDF moves") {
  const auto r = load_robot(robot_file("everything.sdf"));
  CHECK(r.chain.dofs() == 7);
  auto s = r.chain.make_state();
  auto q = neutral_configuration(r.chain);
  const auto at = [&](const char* frame) { return forward_kinematics(r.chain, s, q, frame).position; };
  CHECK(at("hand") == vec3<>{1.5, -0.75, 3});  // y of the mount is z of the world, its z is -y
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
      "4: frame 'g': its pose is relative to itself");
  refused("<include/>", "4: model 'm': <include>: has no <uri>");
  joint("hinge", "", "type 'hinge' is none of revolute");
  joint("gearbox", "", "has no <gearbox_reference_body>");
  joint("fixed", "<pose>1 2</pose>", "<pose>: must have six numbers, got 2");
  joint("fixed", "<pose relative_to='c'/>", "there is no frame 'c'");
  joint("screw", "<axis/><thread_pitch>0</thread_pitch>", "thread_pitch must not be 0");
  refused("<model name='n'/><joint name='j' type='fixed'><parent>a</parent><child>n</child></joint>",
          "4: joint 'j': the frame 'n' is not attached to a link");
  refused("<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>",
          "4: frame 'g': it is attached to itself");
  refused("<link name='c'><gravity>perhaps</gravity></link>", "4: link 'c': <gravity>: 'perhaps' is neither true nor");
  joint("revolute", "", "has no <axis>");
  joint("revolute", "<axis><xyz>0 0 0</xyz></axis>", "<xyz>: the axis has length 0");
  joint("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>2</lower><upper>1</upper></limit></axis>",
        "<limit>: lower 2 is above upper 1");
  CHECK_THROWS_MATCHES(from_sdf("<sdf/>", "a.sdf"), bad_file, says("kte: a.sdf:1: <sdf>: has no <model>"));
}

TEST_CASE("axes of older versions of SDF are in the frame of the model") {
  const auto axis = [](const std::string& version, const std::string& inside) {
    return from_sdf(model(link_text("a") + link_text("b", turned) +
                              joint("j", "revolute", "a", "b", "<axis>" + inside + "</axis>"),
                          version))
        .joints[0]
        .axis;
  };
  const std::string z = "<xyz>0 0 1</xyz>";
  CHECK(axis("1.4", z) == vec3<>{0, 1, 0});  // the joint is turned with its child
  CHECK(axis("1.3", "") == vec3<>{0, 1, 0});
  CHECK(axis("1.5", z) == vec3<>{0, 0, 1});
  CHECK(axis("1.5", z + "<use_parent_model_frame>true</use_parent_model_frame>") == vec3<>{0, 1, 0});
  CHECK(axis("1.6", z + "<use_parent_model_frame>1</use_parent_model_frame>") == vec3<>{0, 1, 0});
  CHECK(axis("1.6", z + "<use_parent_model_frame>0</use_parent_model_frame>") == vec3<>{0, 0, 1});
  CHECK(axis("1.7", "<xyz expressed_in='__model__'>0 0 1</xyz>") == vec3<>{0, 1, 0});
  CHECK(axis("1.10", z) == vec3<>{0, 0, 1});
  const auto d = from_sdf(model(link_text("a") + link_text("b", "<pose frame='a'>0 0 1 0 0 0</pose>"), "1.6"));
  CHECK(d.not_read.empty());
  CHECK(has(from_sdf(model(link_text("a", "<pose frame='b'/>"), "1.7")).not_read, "<pose>: its frame is not read"));
  CHECK(has(from_sdf(model(link_text("a"), "1.99")).warnings, "version '1.99' is not known: it is read as 1.12"));
  CHECK(has(from_sdf("<sdf><model name='m'><link name='a'/></model></sdf>").warnings, "has no version"));
}

TEST_CASE("gravity is that of the world, in the axes of the root") {
  const auto gravity = [](const std::string& world, const std::string& inside, const std::string& version = "1.6") {
    return from_sdf(sdf("<world name='w'>" + world + "<model name='m'>" + inside + "</model></world>", version))
        .gravity;
  };
  CHECK(gravity("", link_text("a")) == vec3<>{0, 0, -9.8});
  CHECK(gravity("<gravity>0 0 -2</gravity>", link_text("a")) == vec3<>{0, 0, -2});
  CHECK(gravity("<physics><gravity>0 0 -3</gravity></physics>", link_text("a"), "1.5") == vec3<>{0, 0, -3});
  CHECK(gravity("<gravity>0 0 -2</gravity>", turned + link_text("a")) == vec3<>{0, -2, 0});
  CHECK(gravity("<gravity>0 0 -2</gravity>", link_text("a", turned)) == vec3<>{0, -2, 0});
  CHECK(!from_sdf(model(link_text("a"))).gravity);
  CHECK(from_sdf(model(link_text("a", turned))).gravity == vec3<>{0, -9.81, 0});
  CHECK(!from_sdf(model(turned + link_text("a") + joint("j", "fixed", "world", "a"))).gravity);
  const auto d = from_sdf(model(link_text("a") + link_text("b", "<gravity>false</gravity>")));
  CHECK((d.links[0].gravity_compensation == 0 && d.links[1].gravity_compensation == 1));
}

TEST_CASE("empty texts of SDF are defaults, and what is not modelled is said once") {
  auto d = from_sdf(model(R"(<link name='a'>
      <inertial><mass></mass><inertia><ixx> </ixx></inertia><fluid_added_mass/></inertial>
      <velocity_decay><linear>0.1</linear></velocity_decay> <kinematic>1</kinematic>
      <visual name='v'><geometry><box/></geometry><pose/></visual> <visual name='w'/>
      <visual name='x'><geometry><mesh><uri>1</uri><uri>2</uri></mesh></geometry></visual>
      <collision name='c'><pose relative_to='f'>0 0 1 0 0 0</pose><geometry><empty/></geometry>
        <surface><friction/></surface></collision>
      <collision name='e'><geometry/><surface><bounce/></surface></collision> <collision name='n'><surface/></collision>
      <drake:deformable_properties/> <enable_wind>1</enable_wind>
    </link> <frame name='f'><pose>1 0 0 0 0 0</pose></frame> <gripper name='g'/> <enable_wind>0</enable_wind>
    <plugin name='drive' filename='f'><left_joint>j</left_joint></plugin> <plugin name='p2' filename='joint-controller'/>
    <plugin name='state' filename='joint-state-publisher'/> <plugin name='q' filename='f'/>)"));
  const auto& a = d.links[0];
  CHECK((a.inertial->mass == 1 && a.inertial->inertia == sym3<>{1, 0, 0, 1, 0, 1}));
  CHECK((a.visuals[0].size == vec3<>{1, 1, 1} && a.visuals[2].mesh == "1"));
  CHECK(a.collisions[0].origin.position == vec3<>{1, 0, 1});
  CHECK(has(d.warnings, "<uri>: occurs twice; the first is used"));
  CHECK(has(d.not_read, "visual 'w': has no <geometry>"));
  CHECK(has(d.not_read, "link 'a': <enable_wind>: not read"));
  CHECK(has(d.warnings, "<surface>: contacts are not modelled: it is not read, as all 2 of the model", true));
  CHECK(has(d.warnings, "plugins that act on joints are not read: 'drive', 'p2'", true));
  CHECK(has(d.warnings, "plugins are not read: 'state', 'q'"));
  for (const auto* what :
       {"<fluid_added_mass>", "<velocity_decay>", "<kinematic>", "<drake:deformable_properties>", "gripper 'g'"})
    CHECK(has(d.warnings, std::string(what) + ": not read", true));
  CHECK(std::count_if(d.warnings.begin(), d.warnings.end(), [](const auto& n) { return n.changes_motion; }) == 7);
  d = from_sdf(sdf("<world name='w'><wind><linear_velocity>1 0 0</linear_velocity></wind><model name='m'>" +
                   link_text("a", "<enable_wind>1</enable_wind>") + "</model></world>"));
  CHECK(has(d.warnings, "<enable_wind>: the wind is not modelled", true));
}

}  // namespace sdf_reader_test
