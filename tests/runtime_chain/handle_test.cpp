#include <kte/runtime_chain/handle.hpp>

#include <type_traits>

#include "catch.hpp"
#include "chain/models.hpp"

namespace handle_test {

using namespace kte;
using kte::test::says;

/// Things of all kinds.
runtime_chain all_kinds() {
  runtime_chain c;
  c << free_joint_3D("trunk", "world", "body") << spherical_joint_3D("ball", "body", "palm")
    << revolute_joint_3D("q1", "palm", "arm", axis::x) << prismatic_joint_3D("q2", "arm", "hand", axis::y)
    << driving_actuator_gen("q1", "motor1") << driving_actuator_gen("q2", "motor2")
    << joint_lugre_gen("q2", "bristles", {1e2, 1.0, 0.4, 1.0, 1.5, 0.1}) << base_2D("table")
    << free_joint_2D("puck", "table", "disc");
  return c;
}

// A handle comes from a chain alone.
static_assert(!std::is_default_constructible_v<handle> && std::is_nothrow_move_constructible_v<handle>);
static_assert(std::is_copy_constructible_v<handle> && std::is_copy_assignable_v<handle>);
static_assert(names_something<handle> && names_something<const char*> && !names_something<int>);

TEST_CASE("each kind of thing has a handle, which finds it and no other") {
  const auto c = all_kinds();
  auto s = c.make_state();
  const auto q1 = c.coordinate("q1"), q2 = c.coordinate("q2"), trunk = c.coordinate("trunk"),
             ball = c.coordinate("ball"), puck = c.coordinate("puck"), motor1 = c.input("motor1"),
             motor2 = c.input("motor2"), bristles = c.internal("bristles"), hand = c.frame("hand"),
             disc = c.frame("disc");
  CHECK(&s.coordinate(q1) == &s.coordinate("q1"));
  CHECK(&s.coordinate(q2) == &s.coordinate("q2"));
  CHECK(&s.coordinate(q1) != &s.coordinate(q2));
  CHECK(&s.pose_3D(trunk) == &s.pose_3D("trunk"));
  CHECK(&s.rotation_3D(ball) == &s.rotation_3D("ball"));
  CHECK(&s.pose_2D(puck) == &s.pose_2D("puck"));
  CHECK(&s.input(motor1) == &s.input("motor1"));
  CHECK(&s.input(motor2) == &s.input("motor2"));
  CHECK(&s.internal(bristles) == &s.internal("bristles"));
  CHECK(&s.frame_3D(hand) == &s.frame_3D("hand"));
  CHECK(&s.frame_2D(disc) == &s.frame_2D("disc"));
  CHECK(&std::as_const(s).frame_2D(disc) == &s.frame_2D("disc"));

  const auto is = [](const handle& h, kind what, int index) { return h.what() == what && h.index() == index; };
  CHECK(is(q1, kind::gen, 0));
  CHECK(is(q2, kind::gen, 1));
  CHECK(is(trunk, kind::pose_3D, 0));
  CHECK(is(ball, kind::rotation_3D, 0));
  CHECK(is(puck, kind::pose_2D, 0));
  CHECK(is(motor2, kind::input, 1));
  CHECK(is(bristles, kind::internal, 0));
  CHECK(is(hand, kind::frame_3D, 4));  // world, body, palm, arm before it
  CHECK(is(disc, kind::frame_2D, 1));
}

TEST_CASE("a handle of another kind is refused, and its kind is named") {
  const auto c = all_kinds();
  auto s = c.make_state();
  const auto refused = [](const char* is, const char* wanted) {
    const auto with_article = [](const char* what) { return (*what == 'i' ? "an " : "a ") + std::string(what); };
    return says("kte: this is the handle of " + with_article(is) + ", not of " + with_article(wanted));
  };
  CHECK_THROWS_MATCHES(s.coordinate(c.coordinate("ball")), bad_argument, refused("rotation", "coordinate"));
  CHECK_THROWS_MATCHES(s.rotation_3D(c.coordinate("trunk")), bad_argument, refused("3D pose", "rotation"));
  CHECK_THROWS_MATCHES(s.pose_3D(c.coordinate("puck")), bad_argument, refused("2D pose", "3D pose"));
  CHECK_THROWS_MATCHES(s.pose_2D(c.coordinate("q1")), bad_argument, refused("coordinate", "2D pose"));
  CHECK_THROWS_MATCHES(s.input(c.internal("bristles")), bad_argument, refused("internal state", "input"));
  CHECK_THROWS_MATCHES(s.internal(c.input("motor1")), bad_argument, refused("input", "internal state"));
  CHECK_THROWS_MATCHES(s.frame_2D(c.frame("hand")), bad_argument, refused("3D frame", "2D frame"));
  CHECK_THROWS_MATCHES(s.frame_3D(c.frame("disc")), bad_argument, refused("2D frame", "3D frame"));
  CHECK_THROWS_MATCHES(jacobian(c, s, c.coordinate("q1")), bad_argument, refused("coordinate", "frame"));
  CHECK_THROWS_MATCHES(forward_kinematics(c, s, c.input("motor1")), bad_argument, refused("input", "frame"));
}

TEST_CASE("a name of another kind, or of nothing, has no handle") {
  const auto c = all_kinds();
  CHECK_THROWS_MATCHES(c.frame("q1"), unknown_name, says("kte: 'q1' is a coordinate, not a frame"));
  CHECK_THROWS_MATCHES(c.coordinate("hand"), unknown_name, says("kte: 'hand' is a 3D frame, not a coordinate"));
  CHECK_THROWS_MATCHES(c.coordinate("motor1"), unknown_name, says("not a coordinate"));
  CHECK_THROWS_MATCHES(c.input("bristles"), unknown_name, says("'bristles' is a"));
  CHECK_THROWS_MATCHES(c.internal("motor1"), unknown_name, says("'motor1' is a"));
  for (const auto* name : {"", "Hand", "hand "}) {
    CHECK_THROWS_MATCHES(c.frame(name), unknown_name, says("nothing named '" + std::string(name) + "'"));
    CHECK_THROWS_AS(c.coordinate(name), unknown_name);
    CHECK_THROWS_AS(c.input(name), unknown_name);
    CHECK_THROWS_AS(c.internal(name), unknown_name);
  }
  const runtime_chain none;
  CHECK_THROWS_AS(none.frame("hand"), unknown_name);
}

TEST_CASE("a handle is of its chain and of copies, not of another that looks the same") {
  const auto c = all_kinds(), twin = all_kinds();
  const auto hand = c.frame("hand");
  const runtime_chain copy = c;
  auto of_copy = copy.make_state(), of_twin = twin.make_state();
  CHECK(&of_copy.frame_3D(hand) == &of_copy.frame_3D("hand"));
  CHECK(jacobian(copy, of_copy, hand) == jacobian(copy, of_copy, "hand"));
  CHECK_THROWS_MATCHES(of_twin.frame_3D(hand), bad_argument, says("another chain"));
  CHECK_THROWS_MATCHES(jacobian(twin, of_twin, hand), bad_argument, says("another chain"));
  runtime_chain whole;
  whole << c;
  auto of_whole = whole.make_state();
  CHECK_THROWS_MATCHES(of_whole.frame_3D(hand), bad_argument, says("another chain"));
}

TEST_CASE("handles of a chain that is moved go with it") {
  auto c = all_kinds();
  const auto hand = c.frame("hand");
  auto s = c.make_state();
  const auto moved = std::move(c);
  CHECK(&s.frame_3D(hand) == &s.frame_3D("hand"));
  auto t = moved.make_state();
  CHECK(&t.frame_3D(hand) == &t.frame_3D("hand"));
  CHECK(jacobian(moved, t, hand) == jacobian(moved, t, "hand"));
  auto of_none = c.make_state();  // what is moved from is a chain without elements
  CHECK_THROWS_AS(of_none.frame_3D(hand), bad_argument);
  CHECK_THROWS_AS(forward_kinematics(c, of_none, hand), bad_argument);
  CHECK_THROWS_AS(c.frame("hand"), unknown_name);
  const auto state = std::move(t);
  CHECK(&state.frame_3D(hand) == &state.frame_3D("hand"));
  CHECK_THROWS_AS(t.frame_3D(hand), bad_argument);
  auto given = std::make_unique<runtime_chain>(all_kinds());
  runtime_chain& part = *given;
  runtime_chain outer;
  outer.append(std::move(given));
  CHECK_THROWS_MATCHES(part.frame("hand"), bad_argument, says("part of another one"));
}

TEST_CASE("a handle that is moved from is of no chain") {
  const auto c = all_kinds();
  auto s = c.make_state();
  auto first = c.frame("hand");
  const auto second = std::move(first);
  CHECK(&s.frame_3D(second) == &s.frame_3D("hand"));
  CHECK_THROWS_AS(s.frame_3D(first), bad_argument);
  first = second;
  CHECK(&s.frame_3D(first) == &s.frame_3D("hand"));
}

TEST_CASE("what changes a chain makes handles of before void, but for states of before") {
  auto c = all_kinds();
  const auto hand = c.frame("hand");
  auto s = c.make_state();
  CHECK_THROWS_AS(c << base_2D("table"), bad_wiring);  // changes nothing
  CHECK(forward_kinematics(c, s, hand).position == vec3<>{});
  c.gravity(zero3{});  // neither
  CHECK(forward_kinematics(c, s, hand).position == vec3<>{});
  const auto void_now = [&](const handle& h) {
    auto t = c.make_state();
    CHECK(&s.frame_3D(hand) == &s.frame_3D("hand"));
    CHECK_THROWS_MATCHES(t.frame_3D(h), bad_argument,
                         says("before the last element was appended or gravity was changed"));
    CHECK(&t.frame_3D(c.frame("hand")) == &t.frame_3D("hand"));
  };
  c << inertia_3D("hand", point_mass(1.0));
  void_now(hand);
  const auto later = c.frame("hand");
  c.gravity(along_z(-9.81));
  void_now(later);
}

TEST_CASE("handles stand for names") {
  runtime_chain c;
  c << revolute_joint_3D("q", "base", "end", axis::x) << rigid_link_3D("end", "tool", along_y(0.5))
    << driving_actuator_gen("q", "motor");
  const auto tool = c.frame("tool"), q = c.coordinate("q"), motor = c.input("motor");
  auto s = c.make_state();
  const std::array x{0.5}, v{2.0};
  CHECK(forward_kinematics(c, s, x, tool).position == forward_kinematics(c, s, x, "tool").position);
  CHECK(jacobian(c, s, x, tool) == jacobian(c, s, x, "tool"));
  CHECK(jacobian(c, s, x, tool, in_world_axes) == jacobian(c, s, x, "tool", in_world_axes));
  CHECK(frame_velocity(c, s, x, v, tool).linear == frame_velocity(c, s, x, v, "tool").linear);
  s.input(motor) = 3.0;
  CHECK(s.input("motor") == 3.0);
  CHECK(&s.coordinate(q) == &s.coordinate("q"));
  CHECK(&s.frame_3D(tool) == &s.frame_3D("tool"));
  const runtime_chain copy = c;
  auto of_copy = copy.make_state();
  CHECK(forward_kinematics(copy, of_copy, x, tool).position == forward_kinematics(c, s, x, tool).position);

  CHECK_THROWS_AS(c.frame("q"), unknown_name);
  CHECK_THROWS_AS(c.coordinate("tool"), unknown_name);
  CHECK_THROWS_AS(c.frame("hand"), unknown_name);
  CHECK_THROWS_AS(jacobian(c, s, x, q), bad_argument);
  CHECK_THROWS_AS(s.input(q), bad_argument);
  c << inertia_3D("tool", point_mass(1.0));
  auto longer = c.make_state();
  CHECK_THROWS_AS(forward_kinematics(c, longer, x, tool), bad_argument);
  CHECK_THROWS_AS(longer.frame_3D(tool), bad_argument);
}

}  // namespace handle_test
