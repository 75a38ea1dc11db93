#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/sdf_reader.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/sdf_texts.hpp"

namespace sdf_model_test {

using namespace kte;
using test::sdf, test::model, test::link_text, test::joint, test::has, test::x90, test::turned, test::says;

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
  refused(floor + arm + other, "",
          "has several models: choose one, as by robot_options::model = \"arm\", of 'floor', 'arm', 'other'");
  refused(arm + arm, "", "has several models: choose one, as by robot_options::model = \"#1\", of 'arm' ('#1'), ");
  refused(box + floor + box, "", "has several models");
  refused(arm, "amr", "has no model 'amr' (robot_options::model), did you mean 'arm'? Its models are 'arm'");
  std::string many;
  for (int i = 0; i < 500; ++i) many += "<model name='m" + std::to_string(i) + "'><link name='l'/></model>";
  refused(many, "",
          "has several models: choose one, as by robot_options::model = \"m0\", of 'm0', 'm1', 'm2', 'm3', "
          "'m4', 'm5', 'm6', 'm7' and 492 more");
  CHECK(has(read(many, "m9").not_read,
            "the robot is model 'm9'; not read: 'm0', 'm1', 'm2', 'm3', 'm4', 'm5', 'm6', 'm7' and 491 more"));
  refused(arm, "leg", "has no model 'leg' (robot_options::model); its models are 'arm'");
  refused(arm + arm, "arm", "has several models called 'arm': choose by its number, of 'arm' ('#1'), 'arm' ('#2')");
  CHECK(read(arm + arm, "#2").links.size() == 2);
  CHECK(read(arm + floor + arm, "#2").name == "floor");
  refused(arm, "#2", "has no model '#2'");
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
  CHECK(has(d.warnings, "joint 'leg::knee': its child 'leg::foot' is already moved by another joint"));
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
  d = from_sdf(model(link_text("a") + link_text("b") + joint("j", "ball", "a", "b") + joint("k", "ball", "a", "b")));
  CHECK((d.joints.size() == 1 && d.closures.size() == 1 && to_robot(d).chain.dofs() == 3));

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
    return from_sdf(model(link_text("a") + link_text("b") + link_text("c") +
                          joint("i", "universal", "a", "c", "<axis/><axis2><xyz>0 1 0</xyz></axis2>") +
                          joint("j", type, "a", "b", rest)));
  };
  const std::string axis = "<axis><xyz>0 0 1</xyz></axis>";
  const double pi = 3.141592653589793;
  CHECK(read("screw", axis + "<screw_thread_pitch>0.5</screw_thread_pitch>").joints[2].pitch ==
        within(0.25 / pi, 1e-17));
  CHECK(read("screw", axis + "<thread_pitch>20</thread_pitch>").joints[2].pitch == -0.05);
  CHECK(read("screw", axis + "<screw_thread_pitch>0.5</screw_thread_pitch><thread_pitch>9</thread_pitch>")
            .joints[2]
            .pitch == within(0.25 / pi, 1e-17));
  CHECK(has(read("screw", axis).warnings, "joint 'j': has no <screw_thread_pitch>: it is 1 m per turn"));
  const auto screw = to_robot(read("screw", axis + "<thread_pitch>20</thread_pitch>"));
  auto s = screw.chain.make_state();
  CHECK(forward_kinematics(screw.chain, s, std::vector{0.0, 0.0, 2.0}, "b").position.z == -0.1);

  auto d = read("revolute2", axis + "<axis2><xyz>0 1 0</xyz></axis2>");
  REQUIRE(d.joints.size() == 4);
  CHECK((d.joints[3].name == "j_2" && d.joints[3].axis == vec3<>{0, 1, 0} && d.joints[2].axis == vec3<>{0, 0, 1}));
  d = read("revolute",
           "<axis><xyz>0 0 1</xyz><mimic joint='i' axis='axis'><multiplier>3</multiplier><offset>1</offset>"
           "<reference>0.5</reference></mimic></axis>");
  REQUIRE(d.joints[2].mimic);
  CHECK((d.joints[2].mimic->joint == "i" && d.joints[2].mimic->ratio == 3 && d.joints[2].mimic->offset == -0.5));
  d = read("revolute", "<axis><xyz>0 0 1</xyz><mimic joint='i' axis='axis2'/></axis>");
  CHECK((d.joints[2].mimic->joint == "i_2" && d.joints[2].mimic->ratio == 1));
  d = read("revolute", "<axis><xyz>0 0 1</xyz><mimic joint='k'/></axis>");
  CHECK_FALSE(d.joints[2].mimic);
  CHECK(has(d.warnings, "joint 'j': it follows joint 'k', which is not in the file: it moves freely", true));
  CHECK(read("revolute", axis + "<drake:gear_ratio>10</drake:gear_ratio><drake:rotor_inertia>0.5</drake:rotor_inertia>")
            .joints[2]
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

}  // namespace sdf_model_test
