#include <kte/contact/surface.hpp>
#include <kte/elements/compliant_contact.hpp>
#include <kte/elements/free_joint.hpp>
#include <kte/elements/joint_limit.hpp>
#include <kte/elements/planar_joint.hpp>
#include <kte/elements/prismatic_joint.hpp>
#include <kte/elements/rigid_contact.hpp>
#include <kte/elements/screw_joint.hpp>
#include <kte/elements/spring.hpp>
#include <kte/io/model_reader.hpp>
#include <kte/manipulators/manipulator.hpp>
#include <kte/view/scene_of.hpp>

#include "../src/view/element_kinds.hpp"
#include "catch.hpp"
#include "chain/gear.hpp"
#include "chain/models.hpp"

namespace scene_test {

using namespace kte;
using kte::test::contains_text;

template <class List>
std::string names(const List& all) {
  std::string text;
  for (const auto& x : all) text += (text.empty() ? "" : " ") + x.name;
  return text;
}

TEST_CASE("the scene of a chain in the plane") {
  const auto s = scene_of(models::pendulum.gravity(along_y(-9.81)));
  CHECK(s.dimension == 2);
  CHECK(s.gravity == std::array<double, 3>{0, -9.81, 0});
  CHECK(s.size == 0.5);
  REQUIRE(names(s.frames) == "base joint tip");
  CHECK((s.frames[0].track == 0 && s.frames[1].track == 1 && s.tracks == 2));
  CHECK((s.frames[2].track == -1 && s.frames[2].parent == 1));
  CHECK(s.frames[2].place == scene::pose{0.5, 0, 0, 1, 0, 0, 0});
  REQUIRE(names(s.coordinates) == "q");
  CHECK((s.coordinates[0].kind == "angle" && s.coordinates[0].unit == "rad" && s.coordinates[0].q == 0));
  REQUIRE(s.joints.size() == 1);
  const auto& j = s.joints[0];
  CHECK((j.name == "q" && j.type == "revolute_joint_2D" && j.kind == "revolute" && j.before == 0 && j.after == 1));
  CHECK((j.has_axis && j.axis == std::array<double, 3>{0, 0, 1} && j.coordinates == std::vector{0}));
  REQUIRE(s.links.size() == 1);
  CHECK((s.links[0].type == "rigid_link_2D" && s.links[0].from == 1 && s.links[0].to == 2));
  REQUIRE(s.bodies.size() == 1);
  CHECK((s.bodies[0].name == "tip" && s.bodies[0].frame == 2 && s.bodies[0].mass == 1));
  CHECK(s.bodies[0].ellipsoid == std::array<double, 3>{});
  REQUIRE(s.recordings.size() == 1);
  CHECK(s.recordings[0].t == std::vector{0.0});
  CHECK((s.q == std::vector{0.0} && s.v == std::vector{0.0}));
  CHECK(s.notes.empty());
}

TEST_CASE("contacts are drawn by their surfaces and by what touches them") {
  const auto body = [](const char* name) { return free_joint_3D(std::string("pose of ") + name, "ground", name); };
  runtime_chain c;
  c << body("ball") << sphere_contact_3D("c", "ground", "ball", half_space{}, 0.1, {}, vec3{0.0, 0.0, 0.2})
    << body("other") << sphere_contact_3D("d", "ground", "other", half_space{}, 0.0, {})
    << compliant_contact_3D("ball", "other", ball_surface(0.1), 0.0, {.stiffness = 1e4}) << body("wheel")
    << disc_contact_3D("rim", "ground", "wheel", half_space{}, vec3{0.0, 1.0, 0.0}, 0.3, {})
    << compliant_contact_3D("ground", "wheel", cylinder_surface(2, vec3{1.0, 0.0, 0.0}), 0.0, {.stiffness = 1e4});
  const auto s = scene_of(c);
  std::string text;
  for (const auto& x : s.shapes) {
    CHECK(x.contact);
    text += s.frames[static_cast<std::size_t>(x.frame)].name + ' ' + x.type;
    for (const double length : x.size) text += ' ' + std::to_string(std::lround(1000 * length));  // mm
    text += '\n';
  }
  CHECK(text ==
        "ground plane 0 0\nball sphere 100\nother sphere 0\nball sphere 100\nother sphere 0\nwheel cylinder 300 6\n"
        "ground cylinder 2000 0\nwheel sphere 0\n");
  CHECK(s.shapes[1].place == scene::pose{0, 0, 0.2, 1, 0, 0, 0});
  CHECK_THAT(to_json(s), contains_text("\"role\":\"contact\""));
  for (const auto& f : s.forces) CHECK(f.kind == "contact");
  CHECK(s.notes.empty());
}
TEST_CASE("a wheel that lies flat at first is drawn") {
  runtime_chain c;
  c << free_joint_3D("pose", "ground", "wheel")
    << disc_contact_3D("rim", "ground", "wheel", half_space{}, axis::z, 0.3, {})
    << rigid_link_3D("wheel", "edge", along_x(0.3));
  const auto s = scene_of(c);
  CHECK(s.recordings[0].positions.back() == 0);
  CHECK(s.shapes.size() == 2);
}

TEST_CASE("the normal of a half space is the z axis of its plane, and other surfaces are named") {
  runtime_chain c;
  c << free_joint_2D("pose", "ground", "ball") << sphere_contact_2D("c", "ground", "ball", half_space{}, 0.1, {})
    << compliant_contact_2D("ground", "ball", surface([](const auto& p) { return p.x - 1; }), 0.0, {.stiffness = 1e4});
  const auto s = scene_of(c);
  REQUIRE(s.shapes.size() == 3);
  const auto& q = s.shapes[0].place;
  const double half = std::sqrt(0.5);  // a quarter turn about -x
  CHECK(std::abs(q[3] - half) + std::abs(q[4] + half) + std::abs(q[5]) + std::abs(q[6]) < 1e-15);
  CHECK_THAT(s.notes.back(), contains_text("the surface of compliant_contact_2D 'ground' is not drawn"));
}

TEST_CASE("static and runtime chains of the same elements have the same scene") {
  runtime_chain appended;
  appended << models::tree;
  const auto s = to_json(scene_of(models::tree));
  CHECK(to_json(scene_of(appended)) == s);
  CHECK(to_json(scene_of(models::element_by_element(models::tree))) == s);
}

TEST_CASE("the scene of a tree: what is rigid, what follows, what acts") {
  const auto s = scene_of(models::tree);
  CHECK(s.dimension == 3);
  CHECK(names(s.frames) == "ground trunk left thigh shank right hand");
  CHECK(s.frames[2].parent == 1);
  const double h = std::sqrt(0.5);
  const scene::pose left{0.1, 0.2, -0.3, h, h, 0, 0};
  for (std::size_t k = 0; k < 7; ++k) CHECK(s.frames[2].place[k] == within(left[k], 1e-15));
  CHECK(names(s.joints) == "slide hip geared knee");
  CHECK(s.joints[1].axis == std::array<double, 3>{0.6, 0, 0.8});
  for (const auto& c : s.coordinates) {
    CHECK(c.follows == (c.name == "geared" || c.name == "wall"));
    CHECK((c.q < 0) == c.follows);
    if (c.name == "slide") CHECK((c.kind == "length" && c.unit == "m"));
  }
  CHECK(names(s.bodies) == "trunk thigh shank hand");
  REQUIRE(s.forces.size() == 6);
  CHECK(
      (s.forces[0].type == "driving_actuator_gen" && s.forces[0].kind == "motor" && s.forces[0].name == "hip, motor"));
  CHECK((s.forces[3].kind == "spring" && s.forces[3].name == "wall, slide" && s.forces[3].coordinates.size() == 2));
  CHECK(s.forces[4].kind == "damper");
}

TEST_CASE("bodies are drawn as ellipsoids of equal inertia") {
  // m (b^2 + c^2)/5 and so on for a = 0.3, b = 0.2, c = 0.1, turned about z by 0.5 rad.
  const double m = 7, a = 0.3, b = 0.2, c = 0.1, cos = std::cos(0.5), sin = std::sin(0.5);
  const double x = m * (b * b + c * c) / 5, y = m * (a * a + c * c) / 5, z = m * (a * a + b * b) / 5;
  const sym3<> turned{x * cos * cos + y * sin * sin, (x - y) * sin * cos, 0, x * sin * sin + y * cos * cos, 0, z};
  runtime_chain chain;
  chain << base_3D("world") << inertia_3D("world", rigid_body{m, vec3{0.1, 0.2, 0.3}, turned});
  const auto s = scene_of(chain);
  REQUIRE(s.bodies.size() == 1);
  const auto& body = s.bodies[0];
  CHECK(body.centre == std::array<double, 3>{0.1, 0.2, 0.3});
  auto half = body.ellipsoid;
  // Along its longest half axis stands the unit vector (cos, sin, 0).
  const auto longest = static_cast<std::size_t>(std::max_element(half.begin(), half.end()) - half.begin());
  const auto& q = body.orientation;
  const auto axes = matrix(unit_quaternion<>{q[0], q[1], q[2], q[3]});
  const std::array<vec3<>, 3> columns{vec3<>{axes.x.x, axes.y.x, axes.z.x}, vec3<>{axes.x.y, axes.y.y, axes.z.y},
                                      vec3<>{axes.x.z, axes.y.z, axes.z.z}};
  CHECK(std::abs(dot(columns[longest], vec3<>{cos, sin, 0})) == within(1, 1e-14));
  std::sort(half.begin(), half.end());
  CHECK(half[0] == within(c, 1e-15));
  CHECK(half[1] == within(b, 1e-15));
  CHECK(half[2] == within(a, 1e-15));
}

TEST_CASE("joints by their kinds, with placements, axes in the base and ranges by stops") {
  runtime_chain c;
  c << free_joint_3D("pose", "world", "trunk")
    << prismatic_joint_3D("x", "trunk", "slider", axis::x).at(along_z(0.2), quarter_turn_z)
    << screw_joint_3D("turn", "slider", "nut", axis::z, 0.01)
    << planar_joint_3D("plane", "nut", "puck").at(zero3{}, quarter_turn_x)
    << joint_limit_gen("x", {.lower = -0.1, .upper = 0.4, .stiffness = 1e4, .damping = 10.0})
    << spring_3D("world", "puck", 1.0, 10.0);
  const auto s = scene_of(c);
  std::string kinds;
  for (const auto& j : s.joints) kinds += j.kind + " ";
  CHECK(kinds == "free prismatic screw planar ");
  CHECK(!s.joints[0].has_axis);
  CHECK(s.joints[1].axis == std::array<double, 3>{0, 1, 0});
  CHECK((s.joints[1].lower == -0.1 && s.joints[1].upper == 0.4));
  CHECK(s.joints[3].axis == std::array<double, 3>{0, -1, 0});
  CHECK(s.coordinates[0].kind == "pose");
  CHECK((s.coordinates[1].lower == -0.1 && s.coordinates[1].q == 7 && s.coordinates[1].v == 6));
  CHECK(s.coordinates[3].kind == "pose_2D");
  CHECK(s.q.size() == 12);
  CHECK(s.q[3] == 1);
  REQUIRE(s.forces.size() == 2);
  CHECK((s.forces[0].kind == "limit" && s.forces[1].kind == "spring"));
  CHECK(s.forces[1].frames == std::vector{0, 4});
}

TEST_CASE("manipulators have the ranges of their limits") {
  const auto chain = models::pendulum;
  auto limits = unlimited(chain);
  limits.lower[0] = -0.5;
  const auto s = scene_of(manipulator(chain, models::tip, limits));
  CHECK((s.coordinates.at(0).lower == -0.5 && s.coordinates[0].upper == scene::none && s.joints.at(0).lower == -0.5));
}

TEST_CASE("elements of the program's own are drawn, and then there is no model") {
  runtime_chain c;
  c << revolute_joint_2D("q", "base", "arm") << connect(kte::test::gear{2.0}, "q", "p")
    << revolute_joint_2D("p", "arm", "hand");
  CHECK(scene_of(c).model.empty());
  CHECK_THAT(scene_of(c).notes.at(0), kte::test::contains_text("'gear_gen' is not an element of the library"));
  CHECK(!scene_of(models::pendulum).model.empty());
}

TEST_CASE("the model of a scene is the chain") {
  CHECK(from_json(scene_of(models::tree).model) == record_of(models::tree));
}

TEST_CASE("all elements of the library are known") {
  for (const auto& type : element_registry::standard().types()) {
    INFO(type);
    CHECK(view::kind_of_element(type).as != view::drawn::unknown);
  }
  CHECK(view::kind_of_element("gear_gen").as == view::drawn::unknown);
}

}  // namespace scene_test
