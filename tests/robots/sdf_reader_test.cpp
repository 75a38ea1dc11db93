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
  CHECK(d.not_read.empty());
  REQUIRE(d.warnings.size() == 5);
  CHECK((d.warnings[1].line == 31 && d.warnings[1].text.starts_with("link 'slider': has no <inertial>: it has 1 kg")));
  CHECK((d.warnings[4].line == 43 && d.warnings[4].text == "plugin 'p': plugins are not read: 'p'"));
  REQUIRE(d.frames.size() == 1);
  CHECK((d.frames[0].name == "seat" && d.frames[0].link == "trunk" && d.frames[0].origin.position.z == 1));
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
      "4: frame 'g': its pose is relative to itself");
  refused("<include/>", "4: model 'm': <include>: has no <uri>");
  joint("hinge", "", "type 'hinge' is none of revolute");
  joint("gearbox", "", "type 'gearbox' is not read: it couples two other joints");
  joint("fixed", "<pose>1 2</pose>", "<pose>: must have six numbers, got 2");
  joint("fixed", "<pose relative_to='c'/>", "there is no frame 'c'");
  joint("screw", "<axis/><thread_pitch>0</thread_pitch>", "thread_pitch must not be 0");
  refused("<model name='n'/><joint name='j' type='fixed'><parent>a</parent><child>n</child></joint>",
          "4: joint 'j': the frame 'n' is attached to no link");
  refused("<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>",
          "4: frame 'g': it is attached to itself");
  refused("<link name='c'><gravity>perhaps</gravity></link>", "4: link 'c': <gravity>: 'perhaps' is neither true nor");
  joint("revolute", "", "has no <axis>");
  joint("revolute", "<axis><xyz>0 0 0</xyz></axis>", "<xyz>: the axis has length 0");
  joint("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>2</lower><upper>1</upper></limit></axis>",
        "<limit>: lower 2 is above upper 1");
  CHECK_THROWS_MATCHES(from_sdf("<sdf/>", "a.sdf"), bad_file, says("kte: a.sdf:1: <sdf>: has no <model>"));
}

namespace {
std::string sdf(const std::string& inside, const std::string& version = "1.11") {
  return "<sdf version='" + version + "'>" + inside + "</sdf>";
}
std::string model(const std::string& inside, const std::string& version = "1.11") {
  return sdf("<model name='m'>" + inside + "</model>", version);
}
std::string link_text(const std::string& name, const std::string& rest = "") {
  return "<link name='" + name + "'>" + rest + "<inertial><mass>1</mass><inertia/></inertial></link>";
}
std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& rest = "<axis/>") {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" +
         rest + "</joint>";
}
bool has(const std::vector<robot_note>& notes, const std::string& text, bool moves = false) {
  for (const auto& n : notes)
    if (n.text.find(text) != std::string::npos && n.changes_motion == moves) return true;
  return false;
}
const mat3<vec3<>> x90{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
const std::string turned = "<pose>0 0 0 1.5707963267948966 0 0</pose>";
}  // namespace

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

TEST_CASE("of several models one is chosen") {
  const std::string arm = "<model name='arm'>" + link_text("a") + link_text("b") + joint("j", "revolute", "a", "b") +
                          "</model>",
                    box = "<model name='box'>" + link_text("c") + "</model>",
                    floor = "<model name='floor'><static>1</static>" + link_text("d") + "</model>",
                    other = "<model name='other'>" + link_text("e") + link_text("f") + joint("j", "ball", "e", "f") +
                            "</model>";
  const auto read = [](const std::string& models, const std::string& chosen = "") {
    return from_sdf(sdf("<world name='w'>" + models + "<light name='sun'/></world>"), "w.sdf", {.model = chosen});
  };
  auto d = read(floor + box);
  CHECK(d.name == "box");
  CHECK(has(d.not_read, "the robot is model 'box'; not read: 'floor'"));
  CHECK(has(d.not_read, "light 'sun': not read"));
  CHECK(read(floor + box + arm).name == "arm");
  CHECK(read(floor + box + arm, "floor").name == "floor");
  CHECK(read(floor).name == "floor");
  const auto refused = [&](const std::string& models, const std::string& chosen, const std::string& why) {
    CHECK_THROWS_MATCHES(read(models, chosen), bad_file, says("w.sdf:1: <sdf>: " + why));
  };
  refused(arm + other, "", "has several models: choose one by robot_options::model, of 'arm', 'other'");
  refused(box + floor + box, "", "has several models");
  refused(arm, "leg", "has no model 'leg' (robot_options::model); its models are 'arm'");
  refused(arm + arm, "arm", "has several models called 'arm'");
  const std::string weld = joint("weld", "fixed", "world", "arm::a", ""),
                    far = joint("far", "fixed", "box", "box2", "");
  d = read(arm + box + weld + far);
  CHECK(has(d.warnings, "joint 'weld': joints of the world are not read", true));
  CHECK(has(d.not_read, "joint 'far': not read"));
}

TEST_CASE("models in models, and their frames") {
  const std::string leg = "<model name='leg'><pose>0 0 1 0 0 0</pose>" + link_text("foot", "<pose>1 0 0 0 0 0</pose>") +
                          "<frame name='toe'><pose>2 0 0 0 0 0</pose></frame>" + link_text("shin") +
                          joint("knee", "revolute", "shin", "foot") + "</model>";
  auto d = from_sdf(model(link_text("hip") + leg + joint("j", "revolute", "hip", "leg::toe") +
                          "<frame name='mark' attached_to='leg::toe'><pose>0 0 5 0 0 0</pose></frame>"));
  CHECK((d.links[1].name == "leg::foot" && d.links[2].name == "leg::shin"));
  REQUIRE(d.joints.size() == 2);
  CHECK(d.joints[0].name == "leg::knee");
  // the toe moves with the canonical link, the foot: its joint is turned round
  CHECK((d.joints[1].child == "leg::foot" && d.joints[1].origin.position == vec3<>{2, 0, 1}));
  CHECK(d.joints[1].child_pose.position == vec3<>{-1, 0, 0});
  CHECK((d.joints[0].parent == "leg::foot" && d.joints[0].child == "leg::shin"));
  CHECK(d.joints[0].axis == vec3<>{0, 0, -1});
  CHECK((d.joints[0].origin == robot_pose{} && d.joints[0].child_pose.position == vec3<>{-1, 0, 0}));
  CHECK(has(d.warnings, "joint 'leg::knee': its child 'leg::foot' hangs on another joint"));
  REQUIRE(d.frames.size() == 2);
  CHECK((d.frames[0].name == "leg::toe" && d.frames[0].link == "leg::foot" && d.frames[0].origin.position.x == 1));
  CHECK((d.frames[1].name == "mark" && d.frames[1].link == "leg::foot" && d.frames[1].origin.position.z == 5));
  CHECK(to_robot(d).chain.dofs() == 2);

  d = from_sdf(model("<model name='n' canonical_link='y' placement_frame='f'><pose>0 0 7 0 0 0</pose>" +
                     link_text("x") + link_text("y", "<pose>3 0 0 0 0 0</pose>") +
                     "<frame name='f'><pose>1 0 0 0 0 0</pose></frame>" + joint("j", "fixed", "x", "y", "") +
                     "</model>" + link_text("z") + joint("k", "fixed", "z", "n", "")));
  CHECK((d.joints[1].child == "n::y" && d.joints[1].origin.position == vec3<>{-1, 0, 7}));
  CHECK(d.joints[1].child_pose.position == vec3<>{3, 0, 0});
  d = from_sdf(model("<placement_frame/><pose>0 0 2 0 0 0</pose>" + link_text("a", "<pose>0 0 1 0 0 0</pose>") +
                     joint("j", "fixed", "world", "a", "")));
  CHECK(d.joints[0].origin.position == vec3<>{0, 0, 3});
  d = from_sdf(sdf("<model name='m' placement_frame='a'><pose>0 0 2 0 0 0</pose>" +
                   link_text("a", "<pose>0 0 1 0 0 0</pose>") + joint("j", "fixed", "world", "a", "") + "</model>"));
  CHECK(d.joints[0].origin.position == vec3<>{0, 0, 2});
}

TEST_CASE("parts of a model that no joint connects move freely, and what is static does not move") {
  auto d = from_sdf(model(link_text("a", turned) + link_text("b", "<pose>0 0 1 0 0 0</pose>") + link_text("c") +
                          joint("j", "revolute", "b", "c")));
  REQUIRE(d.joints.size() == 2);
  CHECK((d.joints[1].is == robot_joint::kind::floating && d.joints[1].name == "b.free" && d.joints[1].parent == "a"));
  CHECK((d.joints[1].origin.position == vec3<>{0, 1, 0} && d.joints[1].origin.rotation == transpose(x90)));
  CHECK(has(d.warnings, "link 'b': no joint connects it with 'a': it moves freely, by a floating joint 'b.free'"));
  CHECK(to_robot(d).chain.dofs() == 7);
  d = from_sdf(model(link_text("a") + link_text("b") + joint("weld", "fixed", "world", "b", "")));
  CHECK((d.joints[1].parent == "world" && d.joints[1].child == "a"));
  d = from_sdf(sdf("<model name='m' canonical_link='b'>" + link_text("a") + link_text("b") + "</model>"));
  CHECK((d.joints[0].parent == "b" && d.joints[0].child == "a"));
  d = from_sdf(
      model(link_text("a") + link_text("b") + link_text("c") + joint("j", "revolute", "a", "c") +
            joint("k", "prismatic", "b", "c", "<axis><limit><lower>1</lower><upper>2</upper></limit></axis>")));
  CHECK((d.joints[1].parent == "c" && d.joints[1].child == "b" && d.joints[1].axis == vec3<>{0, 0, -1}));
  CHECK((d.joints[1].lower == 1 && d.joints[1].upper == 2));
  CHECK_THROWS_MATCHES(to_robot(from_sdf(model(link_text("a") + link_text("b") + joint("j", "ball", "a", "b") +
                                               joint("k", "ball", "a", "b")))),
                       bad_file, says("loops are not read"));

  d = from_sdf(model("<static>true</static>" + link_text("a") + link_text("b") + joint("j", "revolute", "a", "b")));
  CHECK((d.joints.size() == 1 && d.joints[0].is == robot_joint::kind::fixed && d.joints[0].child == "b"));
  CHECK(has(d.not_read, "model 'm': it is static"));
  CHECK(d.warnings.size() == 1);  // of the axis
  d = from_sdf(model("<static>1</static>" + link_text("a") + "<model name='n'>" + link_text("b") + "</model>"));
  CHECK((d.joints.size() == 1 && d.joints[0].is == robot_joint::kind::fixed && d.joints[0].name == "n::b.static"));
  d = from_sdf(model("<pose>0 0 2 0 0 0</pose>" + link_text("a") + "<model name='n'><static>1</static>" +
                     link_text("b") + "</model>" + joint("j", "revolute", "a", "n::b")));
  REQUIRE(d.joints.size() == 2);
  CHECK((d.joints[1].parent == "world" && d.joints[1].child == "n::b" && d.joints[1].origin.position.z == 2));
  CHECK((d.joints[0].parent == "n::b" && d.joints[0].child == "a"));
}

TEST_CASE("names that SDF keeps or that come twice") {
  const auto d = from_sdf(model(link_text("world", "<pose>0 0 1 0 0 0</pose>") + link_text("a") + link_text("arm") +
                                    joint("arm", "revolute", "world", "a") + joint("k", "fixed", "a", "arm", ""),
                                "1.6"));
  CHECK(has(d.warnings, "link 'world': it has the name that SDF keeps for the world"));
  CHECK((d.links.size() == 3 && d.joints[0].parent == "world" && d.joints[0].origin.position.z == -1));
  CHECK((d.joints[0].name == "arm" && d.joints[1].child == "arm"));
  CHECK(to_robot(d).chain.dofs() == 1);
  const auto two = from_sdf(model(link_text("a") + link_text("b") + link_text("b2") +
                                  joint("j", "universal", "a", "b", "<axis/><axis2/>") +
                                  joint("k", "universal", "b2", "b", "<axis/><axis2/>")));
  CHECK((two.links[3].name == "b.cross" && two.links[4].name == "b.cross'"));
}

TEST_CASE("inertias from shapes") {
  const auto body = [](const std::string& inertial, const std::string& shapes) {
    return *from_sdf(model("<link name='a'>" + inertial + shapes + "</link>")).links[0].inertial;
  };
  const std::string geometry = "<geometry><box><size>1 2 3</size></box></geometry></collision>";
  const auto shape = [](const std::string& g) {
    return "<collision name='c'><geometry>" + g + "</geometry></collision>";
  };
  CHECK(body("<inertial auto='true'/>", "<collision name='c'>" + geometry).mass == within(6000, 1e-12));
  auto b = body("<inertial auto='true'><density>10</density></inertial>",
                "<collision name='c'><pose>0 0 1 0 0 0</pose>" + geometry);
  CHECK((b.mass == within(60, 1e-13) && b.com == vec3<>{0, 0, 1}));
  CHECK(b.inertia.xx == within(65, 1e-13));  // 60 (4 + 9)/12
  CHECK(b.inertia.zz == within(25, 1e-13));
  b = body("<inertial auto='1'><density>10</density><mass>6</mass></inertial>",
           "<collision name='c'><density>2</density>" + geometry +
               "<collision name='d'><density>2</density><pose>4 0 0 0 0 0</pose>" + geometry);
  CHECK((b.mass == 6 && b.com == vec3<>{2, 0, 0}));
  CHECK(b.inertia.xx == within(6.5, 1e-14));
  CHECK(b.inertia.yy == within(3 * 10.0 / 12 * 2 + 6 * 4, 1e-13));
  const double pi = 3.141592653589793;
  CHECK(body("<inertial auto='true'/>", shape("<sphere/>")).mass == within(4000 * pi / 3, 1e-11));
  CHECK(body("<inertial auto='true'/>", shape("<cylinder/>")).mass == within(1000 * pi, 1e-11));
  CHECK(body("<inertial auto='true'/>", shape("<capsule/>")).mass == within(1000 * pi * (1.0 / 4 + 1.0 / 6), 1e-11));
  CHECK(body("<inertial auto='true'/>", shape("<ellipsoid><radii>1 2 3</radii></ellipsoid>")).mass ==
        within(8000 * pi, 1e-10));
  CHECK(body("<inertial auto='true'/>", shape("<box/>")).mass == within(1000, 1e-12));
  const auto refused = [&](const std::string& inertial, const std::string& shapes, const std::string& why) {
    CHECK_THROWS_MATCHES(body(inertial, shapes), bad_file, says(why));
  };
  refused("<inertial auto='true'/>", "",
          "link 'a': <inertial>: its inertia is that of its collisions, but the link has none");
  refused("<inertial auto='true'/>", shape("<mesh><uri>m.dae</uri></mesh>"),
          "collision 'c': meshes are not read as bodies");
  refused("<inertial auto='true'/>", shape("<plane/>"), "collision 'c': planes are not read as bodies");
  refused("<inertial auto='true'/>", shape("<cone/>"), "collision 'c': its shape is not read as bodies");
  refused("<inertial auto='true'/>", shape("<sphere><radius>0</radius></sphere>"), "its sizes must be positive");
  refused("<inertial auto='true'><density>0</density></inertial>", shape("<box/>"), "density must be positive, got 0");
}

TEST_CASE("joints of SDF that other formats do not have") {
  const auto read = [](const std::string& type, const std::string& rest) {
    return from_sdf(model(link_text("a") + link_text("b") + link_text("c") + joint("i", "revolute", "a", "c") +
                          joint("j", type, "a", "b", rest)));
  };
  const std::string axis = "<axis><xyz>0 0 1</xyz></axis>";
  const double pi = 3.141592653589793;
  CHECK(read("screw", axis + "<screw_thread_pitch>0.5</screw_thread_pitch>").joints[1].pitch ==
        within(0.25 / pi, 1e-17));
  CHECK(read("screw", axis + "<thread_pitch>20</thread_pitch>").joints[1].pitch == -0.05);
  CHECK(read("screw", axis + "<screw_thread_pitch>0.5</screw_thread_pitch><thread_pitch>9</thread_pitch>")
            .joints[1]
            .pitch == within(0.25 / pi, 1e-17));
  CHECK(has(read("screw", axis).warnings, "joint 'j': has no <screw_thread_pitch>: it is 1 m for a turn"));
  const auto screw = to_robot(read("screw", axis + "<thread_pitch>20</thread_pitch>"));
  auto s = screw.chain.make_state();
  CHECK(forward_kinematics(screw.chain, s, std::vector{0.0, 2.0}, "b").position.z == -0.1);

  auto d = read("revolute2", axis + "<axis2><xyz>0 1 0</xyz></axis2>");
  REQUIRE(d.joints.size() == 3);
  CHECK((d.joints[2].name == "j_2" && d.joints[2].axis == vec3<>{0, 1, 0} && d.joints[1].axis == vec3<>{0, 0, 1}));
  d = read("revolute",
           "<axis><xyz>0 0 1</xyz><mimic joint='i' axis='axis'><multiplier>3</multiplier><offset>1</offset>"
           "<reference>0.5</reference></mimic></axis>");
  REQUIRE(d.joints[1].mimic);
  CHECK((d.joints[1].mimic->joint == "i" && d.joints[1].mimic->ratio == 3 && d.joints[1].mimic->offset == -0.5));
  d = read("revolute", "<axis><xyz>0 0 1</xyz><mimic joint='i' axis='axis2'/></axis>");
  CHECK((d.joints[1].mimic->joint == "i_2" && d.joints[1].mimic->ratio == 1));
  CHECK(read("revolute", axis + "<drake:gear_ratio>10</drake:gear_ratio><drake:rotor_inertia>0.5</drake:rotor_inertia>")
            .joints[1]
            .dynamics.armature == 50);
  CHECK(has(read("revolute", "<axis/>").warnings, "<axis>: has no <xyz>: it is 0 0 1"));
  d = read("revolute",
           axis +
               "<physics><ode><max_force>1</max_force><velocity>2</velocity><suspension><cfm>1</cfm></suspension>"
               "</ode></physics>");
  CHECK(has(d.warnings, "<ode>: its motor is not read", true));
  CHECK(has(d.warnings, "<suspension>: not read", true));
  CHECK(has(d.not_read, "<physics>: not read"));
  d = read("revolute",
           "<axis><xyz>0 0 1</xyz><limit><stiffness>1</stiffness><dissipation>1</dissipation></limit></axis>");
  CHECK((has(d.not_read, "<stiffness>: not read") && has(d.not_read, "<dissipation>: not read")));
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
  CHECK(has(d.warnings, "<uri>: comes a second time; the first is taken"));
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
