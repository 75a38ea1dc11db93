#include <kte/kte.hpp>
#include <kte/robots/check_robot.hpp>
#include <kte/robots/detail/mass_condition.hpp>
#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace check_robot_test {

using namespace kte;
using test::heavy, test::joint_text, test::robot_file, test::urdf;

bool found(const std::vector<robot_note>& all, int line, const std::string& text) {
  for (const auto& n : all)
    if (n.line == line && n.text.find(text) != std::string::npos) return true;
  return false;
}

TEST_CASE("a good robot has no findings") {
  CHECK(check_robot(load_urdf(robot_file("iiwa14.urdf"))).empty());
  CHECK(check_robot(load_robot(robot_file("iiwa14.urdf"))).empty());
}

TEST_CASE("what is odd about a robot is found") {
  const auto all = check_robot(load_urdf(robot_file("everything.urdf")));
  CHECK(all.size() == 4);
  CHECK(found(all, 33, "the inertia is not physically realizable"));
  CHECK(found(all, 16, "is 1 quarter turns but for"));
  CHECK(found(all, 16, "the axis has length 2"));
  // rounding errors of angles and axes are no findings
  const auto noise = from_urdf(
      urdf("<link name='a'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
           "iyz='0'/></inertial></link><joint name='j' type='continuous'><parent link='a'/><child link='b'/><origin "
           "rpy='-3.78e-14 1.5707963267948 2e-7'/><axis xyz='0.5774 0.5774 0.5774'/></joint>"));
  CHECK(noise.warnings.empty());

  const auto limits = [](const char* attributes) { return "<limit " + std::string(attributes) + "/>"; };
  const auto d =
      from_urdf(urdf(heavy("a") + heavy("b") + "<link name='c'/>\n<link name='d'/>\n" +
                     joint_text("1", "revolute", "a", "b", limits("effort='0' velocity='0'")) +
                     joint_text("2", "prismatic", "b", "c", limits("lower='-1' upper='1' effort='1' velocity='1'")) +
                     joint_text("3", "fixed", "c", "d", "")));
  const auto odd = check_robot(d);
  CHECK(odd.size() == 5);
  CHECK(found(odd, 6, "joint '1': lower and upper are both 0: it cannot move"));
  CHECK(found(odd, 6, "joint '1': its effort is limited to 0"));
  CHECK(found(odd, 6, "joint '1': its velocity is limited to 0"));
  CHECK(found(odd, 7, "joint '2': it moves no mass"));
  CHECK(found(odd, 0, "the mass matrix is nearly singular"));
  CHECK(check_robot(to_robot(d)).size() == 4);

  CHECK(found(check_robot(from_urdf(urdf(heavy("a") + heavy("b")))), 0, "link 'b' is a root beside link 'a'"));
  CHECK(found(check_robot(from_urdf(urdf(heavy("a")))), 0, "no degrees of freedom"));
}

/// Joints behind each other or beside each other, a follower, and forces; the last body is `light` times as heavy.
robot_description many_joints(int n, bool chain, const std::string& light = "1") {
  std::string text = heavy("root");
  for (int i = 0; i < n; ++i) {
    const auto name = std::to_string(i), parent = chain && i > 0 ? "l" + std::to_string(i - 1) : "root";
    const auto mass = i + 1 == n ? light : "1";
    text += "<link name='l" + name + "'><inertial><origin xyz='0.1 0 0.3'/><mass value='" + mass + "'/><inertia ixx='" +
            mass + "' ixy='0' ixz='0' iyy='" + mass + "' iyz='0' izz='" + mass + "'/></inertial></link>\n" +
            joint_text("j" + name, i % 5 == 4 ? "prismatic" : "continuous", parent, "l" + name,
                       "<origin xyz='0 0 0.5'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/>"
                       "<dynamics damping='0.1' friction='0.2'/>" +
                           std::string(i == 3 ? "<mimic joint='j1' multiplier='-2' offset='0.1'/>" : ""));
  }
  return from_urdf(urdf(text));
}

TEST_CASE("the condition of many coordinates is estimated from below, and not much below") {
  for (const bool chain : {true, false}) {
    const auto c = to_robot(many_joints(40, chain)).chain;
    const auto masses = detail::masses_of(c);
    auto s = c.make_state(), t = masses.make_state();
    REQUIRE(masses.dofs() == c.dofs());
    const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(c.nq(), -2, 3);
    const double exact = detail::exact_condition(c, s, q), estimate = detail::estimated_condition(masses, t, q);
    INFO(estimate << " of " << exact);
    CHECK(estimate <= 1.2 * exact);  // the diagonal of a coordinate with a follower leaves out a product
    CHECK(estimate >= exact / 2);
  }
  const auto nearly = check_robot(to_robot(many_joints(110, false, "1e-12")));
  CHECK(nearly.empty());  // its joint alone is light, whatever the units
  const auto all = check_robot(many_joints(110, true));
  const auto exact = detail::worst_condition(to_robot(many_joints(100, true)).chain);
  const auto estimate = detail::worst_condition(to_robot(many_joints(110, true)).chain);
  CHECK((!exact.estimated && exact.configurations == 20 && estimate.estimated && estimate.configurations == 20));
  CHECK(found(all, 0, "(estimated)") == (estimate.number > 1e8));
}

TEST_CASE("a coordinate without mass, and what takes too long, are found in large robots too") {
  auto r = to_robot(many_joints(110, false));
  r.chain << revolute_joint_3D("free", "root", "nothing", axis::y);
  CHECK(detail::worst_condition(r.chain).number == robot_joint::none);
  auto shared = to_robot(many_joints(110, false));
  shared.chain << revolute_joint_3D("j0", "root", "other", axis::y)
               << inertia_3D("other", point_mass(1.0, along_x(0.5)));
  CHECK(detail::worst_condition(shared.chain).number < 1e8);
  shared.chain << base_3D("wall") << revolute_joint_3D("j0", "wall", "third", axis::y)
               << inertia_3D("third", point_mass(1.0, along_x(0.5)));
  CHECK_FALSE(detail::worst_condition(shared.chain).known);
  CHECK(found(check_robot(shared), 0, "the condition of the mass matrix is not computed: of 109 degrees of freedom"));
}

}  // namespace check_robot_test
