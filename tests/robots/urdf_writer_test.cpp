#include <kte/elements/base.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spherical_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/robots/detail/angles.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/robots/urdf_writer.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace urdf_writer_test {

using namespace kte;
using test::heavy, test::holding, test::joint_text, test::robot_file, test::says, test::urdf;

TEST_CASE("robots written as URDF come back as the same numbers") {
  const auto name = GENERATE("iiwa14.urdf", "everything.urdf", "parts.urdf");
  const robot_options o{.quarter_turn_tolerance = 1e-6};
  const auto r = load_robot(robot_file(name), o);
  const auto text = to_urdf(r);
  const auto again = to_robot(from_urdf(text, "again", o), o);
  const auto here = record_of(again.chain), there = record_of(r.chain);
  REQUIRE(here.elements.size() == there.elements.size());
  for (std::size_t i = 0; i < here.elements.size(); ++i) {
    const auto &x = here.elements[i], &y = there.elements[i];
    CHECK((x.type == y.type && x.connections == y.connections));
    for (std::size_t k = 0; k < x.parameters.size(); ++k)
      for (std::size_t n = 0; n < x.parameters[k].values.size(); ++n)
        CHECK(x.parameters[k].values[n] == within(y.parameters[k].values[n], 4e-16));
  }
  CHECK(again.limits == r.limits);
  CHECK(again.soft_limits == r.soft_limits);
  CHECK(text.find("\"inf\"") == text.npos);
  if (r.name != "everything" && r.name != "iiwa14") return;  // capsules come back as cylinders and balls
  CHECK(here == there);
  CHECK(to_urdf(again) == text);
  REQUIRE(again.shapes.size() == r.shapes.size());
  for (std::size_t i = 0; i < r.shapes.size(); ++i) {
    CHECK((again.shapes[i].frame == r.shapes[i].frame && again.shapes[i].size == r.shapes[i].size));
    CHECK((again.shapes[i].origin == r.shapes[i].origin && again.shapes[i].mesh == r.shapes[i].mesh));
    CHECK((again.shapes[i].rgba == r.shapes[i].rgba && again.shapes[i].scale == r.shapes[i].scale));
  }
}

TEST_CASE("rotations come back to a few rounding errors") {
  for (const double angle : {0.1, 1.5, 1.5707963, 3.0, -2.0})
    for (const double pitch : {0.0, 0.7, 1.5707963, 1.5707926, -1.57, -1.570796326794}) {
      const auto turn = detail::rotation_of_rpy({angle, pitch, 0.5 * angle}, 0);
      runtime_chain c;
      c << revolute_joint_3D("q", "a", "b").at(vec3<>{1, 2, 3}, turn);
      const auto d = from_urdf(to_urdf(c, "<&\">"));
      CHECK(d.name == "<&\">");
      const auto& m = d.joints.at(0).origin.rotation;
      for (const auto& [x, y] : {std::pair{m.x, turn.x}, {m.y, turn.y}, {m.z, turn.z}})
        CHECK(dot(x - y, x - y) == within(0, 4e-16 * 4e-16));
    }
}

TEST_CASE("angles of files come back to the last bit") {
  for (const auto* rpy : {"0.1 0.2 0.3", "1 2 3", "0 1.57079632679 0", "0 0 -3.14159265359", "0.3 3.14159 -1e-5",
                          "-3.1416 1.5708 0.123456789012345", "0 0 0"}) {
    const auto file =
        urdf(heavy("a") + heavy("b") + joint_text("q", "fixed", "a", "b", "<origin rpy='" + std::string(rpy) + "'/>"));
    const auto once = from_urdf(file), twice = from_urdf(to_urdf(once));
    CHECK(once.joints[0].origin == twice.joints[0].origin);
  }
}

TEST_CASE("rotations of rounded entries that are nearly a quarter turn in pitch come back to rounding") {
  for (const double off : {1e-3, 3.7e-6, 1e-9, 1e-12}) {
    const auto turn = detail::rotation_of_rpy({0.4, std::numbers::pi / 2 - off, -1.3}, 0);
    const auto other = detail::rotation_of_rpy({0.3, 0.2, 0.1}, 0);
    const auto rounded = transpose(other) * (other * turn);
    const auto m = detail::rotation_of_rpy(detail::rpy_of_rotation(rounded), 0);
    for (const auto& [x, y] : {std::pair{m.x, rounded.x}, {m.y, rounded.y}, {m.z, rounded.z}})
      CHECK(dot(x - y, x - y) == within(0, 1e-30));
  }
}

TEST_CASE("quarter turns keep their digits beside other angles") {
  const std::string rpy = "0.1 0 1.5707963267948966";
  const auto file = urdf(heavy("a") + heavy("b") + joint_text("q", "fixed", "a", "b", "<origin rpy='" + rpy + "'/>"));
  CHECK(to_urdf(from_urdf(file)) == holding("rpy=\"" + rpy + "\""));
}

TEST_CASE("limits, shapes and children that URDF has no words for") {
  std::vector<robot_note> notes;
  auto r = load_robot(robot_file("parts.urdf"));
  r.chain.gravity(vec3<>{0, 0, -1.5}), r.actuators = {{"m", 3, "turn", 2}};
  r.shapes[0].origin.rotation = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  r.shapes[1].is = robot_shape::form::plane, r.shapes[2].is = robot_shape::form::ellipsoid;
  auto mesh = r.shapes[0], nowhere = mesh;
  mesh.is = robot_shape::form::mesh, mesh.name = "nothing";
  r.shapes.push_back(mesh);
  r.shapes.emplace_back(mesh).mesh = "a.stl";
  r.shapes.emplace_back(mesh).is = robot_shape::form::none;
  r.shapes.emplace_back(nowhere).frame = "nowhere";
  const auto path = [](const std::string& m) { return "x/" + m; };
  const auto text = to_urdf(r, {.not_written = &notes, .mesh_path = path});
  std::vector<std::string> texts;
  for (const auto& n : notes) texts.push_back(n.text);
  CHECK(texts ==
        std::vector<std::string>{"visual capsule is in frame 'nowhere', which is not a link",
                                 "link 'arm': its visual capsule: a capsule is written as a cylinder and two balls",
                                 "link 'arm': its shape 'logo' is left out: it is a plane",
                                 "link 'arm': its shape 'nothing' is left out: its mesh '' has no file",
                                 "link 'arm': its shape 'nothing' is left out: its form is not known",
                                 "link 'arm': its collision ellipsoid is left out: it is an ellipsoid",
                                 "gravity 0 0 -1.5 is left out", "actuator 'm' is left out"});
  CHECK(notes[2].line == 19);
  CHECK(text == (holding("<!-- not as in the robot: actuator 'm' is left out -->\n") &&
                 holding("<mesh filename=\"x/a.stl\"/>") && holding("name=\"parts &lt;&amp;>\"")));
  const auto arm = from_urdf(text).links.at(2);
  REQUIRE(arm.visuals.size() == 4);
  CHECK(arm.visuals[0].size == vec3<>{0.1, 0.5, 0});
  CHECK(arm.visuals[1].origin.position == vec3<>{0, 0.25, 0});
  CHECK(arm.visuals[2].origin.position == vec3<>{0, -0.25, 0});
  CHECK(arm.visuals[2].size.x == 0.1);

  auto d = from_urdf(urdf(heavy("a") + heavy("b") + joint_text("q", "continuous", "a", "b", "")));
  CHECK(to_urdf(d) == !holding("<limit"));
  d.joints[0].rate = 5;
  CHECK(to_urdf(d) == holding("<limit effort=\"1e+308\" velocity=\"5\"/>"));
  d.joints[0].soft_upper = 2;  // a continuous joint has no room for it
  CHECK(to_urdf(d) == !holding("inf\""));
  CHECK(to_robot(from_urdf(to_urdf(d))).soft_limits == to_robot(d).soft_limits);
  d.joints[0].child_pose.position = {1, 0, 0};
  CHECK(record_of(to_robot(from_urdf(to_urdf(d))).chain) == record_of(to_robot(d).chain));
  d.links[0].name = "\x01";
  d.joints[0].parent = "\x01";
  CHECK_THROWS_MATCHES(to_urdf(d), bad_argument, says("has a control character, which XML cannot hold"));
  d.links[0].name = d.joints[0].parent = "\xff";
  CHECK_THROWS_MATCHES(to_urdf(d), bad_argument, says("is not UTF-8, and XML cannot hold it"));
  d.links[0].name = d.joints[0].parent = "a\n--b-->";
  d.links[0].visuals.emplace_back();
  CHECK(from_urdf(to_urdf(d)).links[0].name == "a\n--b-->");
  CHECK(to_urdf(d) == holding("link 'a\n- -b- ->': its visual shape is left out"));

  auto& shapes = d.links[1].visuals;
  shapes.resize(4, r.shapes[0]);
  for (auto& s : shapes) s.is = robot_shape::form::sphere, s.material = "paint";
  shapes[1].rgba = {1, 0, 0, 1}, shapes[2].rgba = {1, 0, 0}, shapes[3].rgba = {1, 0};
  CHECK(to_urdf(d) == (holding("<material name=\"paint\">\n        <color rgba=\"0.5 0.5 0.5 1\"/>") &&
                       holding("<material name=\"paint'\">\n        <color rgba=\"1 0 0 1\"/>") &&
                       !holding("paint''") && holding("<material name=\"paint\"/>")));
  for (auto& x : shapes) x.material.clear();
  CHECK(to_urdf(d) == !holding("name=\"'"));
}

TEST_CASE("what URDF cannot say is refused by name") {
  const auto refused = [](const auto& element, const std::string& why) {
    runtime_chain c;
    c << revolute_joint_3D("q", "a", "b") << element;
    CHECK_THROWS_MATCHES(to_urdf(c), bad_argument, says(why));
  };
  refused(spherical_joint_3D("ball", "b", "c"), "kte: joint 'ball': it is spherical, which URDF cannot say");
  refused(screw_joint_3D("s", "b", "c", axis::z, 0.1), "kte: joint 's': it is a screw, which URDF cannot say");
  refused(spring_3D("a", "b", 0.1, 1.0), "kte: spring_3D (anchor1 'a', anchor2 'b'): it is not a link");
  refused(revolute_joint_3D("q", "b", "c"), "its coordinate 'q' moves another joint too");
  runtime_chain c;
  c << base_gen("rest") << revolute_joint_3D("q", "a", "b") << spring_gen("rest", "q", 0.0, 2.0);
  CHECK_THROWS_MATCHES(to_urdf(c), bad_argument,
                       says("kte: joint 'q': it has a spring, which URDF cannot say (robot_writing::lossy: that is"));
  c << inertia_gen("q", 1.0);
  std::vector<robot_note> notes;
  (void)to_urdf(c, "r", {.not_written = &notes, .lossy = true});
  REQUIRE(notes.size() == 3);
  CHECK(notes[0].text == "joint 'q': it has a spring, which URDF cannot say: that is left out");
  CHECK(notes[1].text == "joint 'q': it has a rotor inertia, which URDF cannot say: that is left out");
  CHECK(notes[2].text == "gravity 0 0 0 is left out");
}

}  // namespace urdf_writer_test
