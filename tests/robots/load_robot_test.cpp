#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/forward_kinematics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/robots/load_robot.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include <algorithm>

#include "catch.hpp"
#include "data/iiwa14.hpp"
#include "robots/files.hpp"

namespace load_robot_test {

using namespace kte;
using test::robot_file, test::says;

TEST_CASE("the iiwa14 from a file against 31 digits") {
  const bool fold = GENERATE(false, true);
  const auto r = load_robot(robot_file("iiwa14.urdf"), {.fold_fixed = fold});
  CHECK(r.not_read.empty());
  CHECK(r.warnings.empty());
  CHECK(r.joints == std::vector<std::string>{"q1", "q2", "q3", "q4", "q5", "q6", "q7"});
  CHECK(r.limits.upper[6] == within(3.0543261909900767, 0));
  auto s = r.chain.make_state();
  const auto near = [](double x, long double expected, double scale) {
    CHECK(x == within(static_cast<double>(expected), 8e-16 * scale));  // four rounding errors of the largest number
  };
  for (const auto& x : kte::reference::iiwa14) {
    const auto largest = [](const auto& list) {
      long double most = 0;
      for (const auto y : list) most = std::max(most, y < 0 ? -y : y);
      return static_cast<double>(most);
    };
    for (int i = 0; i < 7; ++i)
      near(inverse_dynamics(r.chain, s, x.q, x.v, x.a)[static_cast<std::size_t>(i)], x.inverse_dynamics[i],
           largest(x.inverse_dynamics));
    for (int i = 0; i < 7; ++i)
      near(forward_dynamics(r.chain, s, x.q, x.v, x.tau)[static_cast<std::size_t>(i)], x.forward_dynamics[i],
           largest(x.forward_dynamics));
    const auto& m = mass_matrix(r.chain, s, x.q);
    for (int i = 0, k = 0; i < 7; ++i)
      for (int j = i; j < 7; ++j, ++k) near(m(i, j), x.mass_matrix[k], largest(x.mass_matrix));
    const auto tool = forward_kinematics(r.chain, s, x.q, "tool");
    near(tool.position.z, x.tool_position[2], 4);  // 4 turned lengths of about a metre
    near(tool.rotation.x.y, x.tool_rotation[1], 4);
  }
}

TEST_CASE("files that are no robots") {
  CHECK_THROWS_MATCHES(load_robot(robot_file("none.urdf")), bad_file, says("none.urdf"));
  const auto refused = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_MATCHES(describe_robot(text, "a.urdf"), bad_file, says(why));
  };
  refused("", "kte: a.urdf:1:1: the file is empty");
  refused("no robot", "kte: a.urdf:1: this is not valid XML: a text stands outside of the elements");
  refused("<robot/><?xml version='1.0'?>",
          "a.urdf:1: this is not valid XML: a declaration <?xml ...?> is not ended by ?>, or stands after an element");
  refused("<robot>\n<link name=a/></robot>", "a.urdf:2: this is not valid XML: an attribute has no value in quotes");
  refused("<robot>\n<link>\n</robot>", "kte: a.urdf:2: this is not valid XML: mismatched element");
  refused("<model/>", "kte: a.urdf:1: <model> is not the root of a supported robot format");
  refused("<robot/>\n<robot/>", "kte: a.urdf:2: an element comes after the end of the first");
  refused("<robot>\n<xacro:macro name='leg'/></robot>", "kte: a.urdf:2: <xacro:macro>: this is a file for xacro");
  refused("<robot>\xff</robot>", "this is not UTF-8");
  std::string deep;
  for (int i = 0; i < 2000; ++i) deep += "<link>";
  refused("<robot>" + deep, "this is not valid XML: element depth exceeded");
}

}  // namespace load_robot_test
