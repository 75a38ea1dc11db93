#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <Eigen/LU>

#include "catch.hpp"
#include "robots/files.hpp"

namespace to_robot_test {

using namespace kte;
using test::heavy, test::joint_text, test::robot_file, test::says, test::urdf;

/// Random numbers, the same every time; of configurations also the quaternions are good, whatever their length.
Eigen::VectorXd numbers(int n, double factor) {
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(factor * (i + 1));
  return x;
}
void same(const pose<mat3<vec3<>>, vec3<>>& a, const pose<mat3<vec3<>>, vec3<>>& b) {
  const auto d = a.position - b.position;
  CHECK(dot(d, d) == within(0, 1e-30));
  for (const auto& [x, y] : {std::pair{a.rotation.x, b.rotation.x}, {a.rotation.y, b.rotation.y}})
    CHECK(dot(x - y, x - y) == within(0, 1e-30));
}
robot made(const std::string& inside, const robot_options& o = {}) {
  return to_robot(from_urdf(urdf(inside), "r.urdf", o), o);
}

TEST_CASE("a joint of every type becomes an element") {
  const auto r = load_robot(robot_file("everything.urdf"), {.quarter_turn_tolerance = 1e-6});
  CHECK(r.joints == std::vector<std::string>{"elbow", "shoulder", "lift", "finger", "puck", "drone"});
  std::vector<std::string> order;
  for (const auto& e : layout(r.chain)) order.push_back(e.name);
  CHECK(order == std::vector<std::string>{"shoulder", "elbow", "lift", "puck", "drone"});
  CHECK(r.chain.dofs() == 3 + 3 + 6);
  CHECK(r.limits.upper[0] == within(2, 0));
  CHECK(r.soft_limits.upper[0] == within(1.5, 0));
  CHECK(r.limits.rate[1] == within(8, 0));
  CHECK(r.limits.effort[2] == within(5, 0));
  CHECK(r.limits.upper[3] == joint_limits<>::none);
  CHECK_NOTHROW(check_limits(r.chain, r.limits));
  CHECK(r.shapes.size() == 2);
  CHECK((r.shapes[1].frame == "ground" && r.shapes[1].collision));
  REQUIRE(r.warnings.size() == 3);
  CHECK(r.warnings[2].line == 33);
  CHECK(r.warnings[2].text ==
        "link 'elbow': the inertia is not physically realizable: its principal moment 3 is above 1 + 1 by 1 "
        "kg m^2; it is taken as published");

  auto s = r.chain.make_state();
  s.coordinate("shoulder").q = 0.3, s.coordinate("lift").q = 0.05;
  s.coordinate("shoulder").q_dot = 2, s.coordinate("elbow").q_dot = 3;
  r.chain.doMotion(s), r.chain.clearForce(s), r.chain.doForce(s);
  CHECK(s.coordinate("finger").q == within(-0.09, 2e-17));
  CHECK(s.frame_3D("tool").position.z == within(-0.5 * std::sin(0.3) + (0.05 * 0.8 + 0.25) * std::cos(0.3), 2e-16));
  // the puck slides and turns in the plane y, z
  s.pose_2D("puck").position = {2, 3};
  r.chain.doMotion(s);
  CHECK(s.frame_3D("puck").position.x == within(0, 0));
  CHECK(s.frame_3D("puck").position.y == within(2, 0));
  CHECK(s.frame_3D("drone").position.z == within(1, 0));

  // what damping and dry friction add to the forces that the motion needs
  const auto without =
      load_robot(robot_file("everything.urdf"), {.quarter_turn_tolerance = 1e-6, .joint_dynamics = false});
  auto s2 = without.chain.make_state();
  auto q = neutral_configuration(r.chain);
  const Eigen::VectorXd v = numbers(12, 0.7), zero = Eigen::VectorXd::Zero(12);
  const auto with_friction =
      Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(inverse_dynamics(r.chain, s, q, v, zero).data(), 12));
  const auto& plain = inverse_dynamics(without.chain, s2, q, v, zero);
  CHECK(with_friction[0] - plain[0] == within(0.125 * v[0], 2e-14));
  CHECK(with_friction[1] - plain[1] == within(0.25 * v[1] + 0.5, 2e-14));
}

TEST_CASE("a joint that mimics another carries its mass through the ratio") {
  const auto slide = [](const std::string& more) {
    return "<axis xyz='1 0 0'/><limit effort='1' velocity='1'/>" + more;
  };
  // named so that the follower's follower comes first
  const auto r = made("<link name='g'/>" + heavy("a") + heavy("b") + heavy("c") +
                      joint_text("c", "prismatic", "g", "c", slide("<mimic joint='b' multiplier='3' offset='1'/>")) +
                      joint_text("b", "prismatic", "g", "b", slide("<mimic joint='a' multiplier='-2' offset='0.5'/>")) +
                      joint_text("a", "prismatic", "g", "a", slide("")));
  auto s = r.chain.make_state();
  CHECK(mass_matrix(r.chain, s, std::vector{0.25})(0, 0) == within(1 + 4 + 36, 0));
  CHECK(forward_kinematics(r.chain, s, "c").position.x == within(3 * (-2 * 0.25 + 0.5) + 1, 0));
  CHECK(r.joints == std::vector<std::string>{"c", "b", "a"});
}

TEST_CASE("joints that follow each other in a long row, the last first") {
  const int n = 20000;
  robot_description d;
  d.links.resize(static_cast<std::size_t>(n) + 1), d.joints.resize(static_cast<std::size_t>(n));
  for (int i = 0; i <= n; ++i) d.links[static_cast<std::size_t>(i)].name = "l" + std::to_string(i);
  for (int i = 0; i < n; ++i) {
    auto& j = d.joints[static_cast<std::size_t>(i)];
    j.name = "j" + std::to_string(i), j.is = robot_joint::kind::prismatic;
    j.parent = "l0", j.child = "l" + std::to_string(i + 1);
    if (i + 1 < n) j.mimic = {"j" + std::to_string(i + 1), 1, 0.5};
  }
  const auto r = to_robot(d, {});
  REQUIRE(r.chain.dofs() == 1);
  auto s = r.chain.make_state();
  CHECK(forward_kinematics(r.chain, s, std::vector{0.25}, "l1").position.x == within(0.25 + 0.5 * (n - 1), 0));
  d.joints.back().mimic = {"j0", 1, 0};
  CHECK_THROWS_AS(to_robot(d, {}), bad_file);
}

TEST_CASE("soft limits are never wider than the hard ones") {
  const auto soft = [](const char* limits) {
    return made("<link name='g'/>" + heavy("a") +
                joint_text("a", "prismatic", "g", "a",
                           "<axis xyz='1 0 0'/><limit lower='-1' upper='2' effort='1' velocity='1'/>"
                           "<safety_controller k_velocity='1' " +
                               std::string(limits) + "/>"))
        .soft_limits;
  };
  const auto wide = soft("soft_lower_limit='-3' soft_upper_limit='4'"),
             narrow = soft("soft_lower_limit='-0.5' soft_upper_limit='1'");
  CHECK((wide.lower[0] == -1 && wide.upper[0] == 2));
  CHECK((narrow.lower[0] == -0.5 && narrow.upper[0] == 1));
}

TEST_CASE("fixed links folded give the same motion") {
  const auto q = load_robot(robot_file("everything.urdf")),
             f = load_robot(robot_file("everything.urdf"), {.fold_fixed = true});
  auto s = q.chain.make_state(), t = f.chain.make_state();
  auto at = neutral_configuration(q.chain);
  at[0] = 0.3, at[1] = 0.4, at[2] = 0.5;
  const auto& m = mass_matrix(q.chain, s, at);
  const auto& n = mass_matrix(f.chain, t, at);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) CHECK(m(i, j) == within(n(i, j), 1e-14));
  same(forward_kinematics(q.chain, s, "tool"), forward_kinematics(f.chain, t, "tool"));
  const auto bodies = [](const robot& r) {
    int count = 0;
    r.chain.for_each_element([&](const kte_element& e) { count += e.record().type == "inertia_3D"; });
    return count;
  };
  CHECK(bodies(q) == 7);
  CHECK(bodies(f) == 6);
}

TEST_CASE("any link can be the root") {
  const auto file = robot_file("iiwa14.urdf");
  const auto r = load_robot(file), turned = load_robot(file, {.root = "link4"});
  auto s = r.chain.make_state(), t = turned.chain.make_state();
  CHECK(layout(turned.chain)[0].name == "q4");
  const auto q = numbers(7, 0.9);
  Eigen::VectorXd same_q(7);
  for (int i = 0; i < 7; ++i)
    for (const auto& e : layout(turned.chain))
      if (e.name == "q" + std::to_string(i + 1)) same_q[e.q] = q[i];
  const auto link4 = forward_kinematics(r.chain, s, q, "link4");
  for (const auto* name : {"base", "link2", "link7", "tool"}) {
    const auto x = forward_kinematics(turned.chain, t, same_q, name);
    same(forward_kinematics(r.chain, s, q, name), compose(link4, x));
  }
  // floating, the inertia that joints feel is the same, whatever link the pose is of
  const auto felt = [&](const char* root) {
    const std::string place = "<origin xyz='0.3 0.2 0.1' rpy='1 2 3'/><axis xyz='1 2 2'/>";
    const auto f = made(heavy("a") + heavy("b") + heavy("c") + joint_text("1", "continuous", "a", "b", place) +
                            joint_text("2", "continuous", "b", "c", place),
                        {.root = root, .floating_base = true});
    auto u = f.chain.make_state();
    auto at = neutral_configuration(f.chain);
    double trace = 0;  // of the part of M^-1 of the joints
    for (const auto& e : layout(f.chain))
      if (e.nq == 1) at[e.q] = e.name == "1" ? 0.4 : 0.7;
    const auto inverse = Eigen::MatrixXd(mass_matrix(f.chain, u, at)).inverse().eval();
    for (const auto& e : layout(f.chain))
      if (e.nq == 1) trace += inverse(e.v, e.v);
    return trace;
  };
  CHECK(felt("c") == within_relative(felt("a"), 1e-14));
  CHECK(felt("b") == within_relative(felt("a"), 1e-14));
  CHECK_THROWS_MATCHES(load_robot(file, {.root = "foot"}), bad_argument, says("has no link 'foot' to be its root"));
  CHECK_THROWS_MATCHES(load_robot(robot_file("everything.urdf"), {.root = "drone"}), bad_argument,
                       says("everything.urdf:56: joint 'drone' has no single coordinate and cannot be turned round"));
}

TEST_CASE("a base that floats, and gravity") {
  const auto r = made(heavy("body"), {.gravity = vec3<>{0, 0, -2}, .floating_base = true, .base_coordinate = "trunk"});
  auto s = r.chain.make_state();
  const auto a = forward_dynamics(r.chain, s, neutral_configuration(r.chain), numbers(6, 0), numbers(6, 0));
  CHECK(a[2] == within(-2, 0));
  CHECK(layout(r.chain)[0].name == "trunk");
  CHECK(s.frame_3D("world").acceleration.z == within(2, 0));
  CHECK_THROWS_MATCHES(made(heavy("world"), {.floating_base = true}), bad_argument,
                       says("has a link or joint 'world'"));
  CHECK(made(heavy("body")).chain.gravity() == vec3<>{0, 0, -9.81});
}

TEST_CASE("links and joints that make no tree") {
  const auto refused = [](const std::string& inside, const std::string& why) {
    CHECK_THROWS_MATCHES(made(inside), bad_file, says("kte: r.urdf:" + why));
  };
  const std::string a = "<link name='a'/>\n", b = "<link name='b'/>\n", c = "<link name='c'/>\n";
  refused("", " the robot has no links");
  refused(a + a, "3: link 'a' is already defined in line 2");
  refused(a + b, "3: link 'b' is a root beside link 'a' (line 2)");
  refused(a + joint_text("j", "fixed", "a", "b"), "3: joint 'j': its child 'b' is not a link");
  refused(a + joint_text("j", "fixed", "b", "a"), "3: joint 'j': its parent 'b' is not a link");
  refused(a + joint_text("j", "fixed", "a", "a"), "3: joint 'j': its parent and its child are the same link 'a'");
  refused(a + b + c + joint_text("j", "fixed", "a", "b") + joint_text("j", "fixed", "b", "c"),
          "6: joint 'j': it is already defined in line 5");
  refused(a + b + c + joint_text("j", "fixed", "a", "c") + joint_text("k", "fixed", "b", "c"),
          "6: joint 'k': its child 'c' is already the child of joint 'j' (line 5): a link has one parent, and closures "
          "close loops");
  refused(a + b + joint_text("j", "fixed", "a", "b") + joint_text("k", "fixed", "b", "a"),
          "5: joint 'k' is part of a cycle");
  refused(a + b + c + joint_text("j", "fixed", "c", "b") + joint_text("k", "fixed", "b", "c"),
          "5: joint 'j' is part of a cycle");
  const auto mimic = [](const char* of) {
    return "<limit effort='1' velocity='1'/><mimic joint='" + std::string(of) + "'/>";
  };
  refused(a + b + c + joint_text("j", "prismatic", "a", "b", mimic("k")) +
              joint_text("k", "prismatic", "a", "c", mimic("j")),
          "5: joint 'j': it mimics joints that mimic each other");
  refused(a + b + c + joint_text("j", "prismatic", "a", "b", mimic("k")) + joint_text("k", "fixed", "a", "c", ""),
          "5: joint 'j': it mimics joint 'k', which has no single coordinate");
  auto d = from_urdf(urdf(a + b + joint_text("j", "continuous", "a", "b", "<limit effort='1' velocity='1'/>")));
  d.joints[0].mimic = {"k"};
  CHECK_THROWS_MATCHES(to_robot(d), bad_file, says("joint 'j': it mimics joint 'k', which does not exist"));
}

TEST_CASE("a link and a joint may have one name, and massless links are links") {
  const auto r = made("<link name='x'/><link name='y'/>" + heavy("z") + joint_text("y", "continuous", "x", "y") +
                      joint_text("z", "continuous", "y", "z"));
  CHECK(r.chain.dofs() == 2);
  CHECK_NOTHROW(r.chain.make_state().frame_3D("y"));
}

}  // namespace to_robot_test
