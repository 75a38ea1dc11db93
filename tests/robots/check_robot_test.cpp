#include <kte/robots/check_robot.hpp>
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

}  // namespace check_robot_test
