#include <kte/robots/load_robot.hpp>

#include "catch.hpp"

namespace mjcf_look_test {

using namespace kte;

robot_description look_of(const std::string& body, const std::string& assets = "") {
  return describe_robot("<mujoco><default><material rgba='0 1 0 1'/></default><asset>" + assets +
                            "</asset><worldbody><body name='b'><joint/><inertial pos='0 0 0' mass='1' "
                            "diaginertia='1 1 1'/>" +
                            body + "</body></worldbody></mujoco>",
                        "look.xml");
}

TEST_CASE("geoms of MJCF that collide in groups above 2 are not to be seen") {
  const auto d = look_of(
      "<geom name='both' size='1'/><geom name='seen' size='1' contype='0' conaffinity='0' group='4'/>"
      "<geom name='collides' size='1' group='3'/><geom name='shown' size='1' group='2'/>");
  const auto names = [](const std::vector<robot_shape>& all) {
    std::string text;
    for (const auto& s : all) text += s.name + " ";
    return text;
  };
  CHECK(names(d.links.back().visuals) == "both seen shown ");
  CHECK(names(d.links.back().collisions) == "both collides shown ");
}

TEST_CASE("geoms of MJCF have the colours of their materials") {
  const auto d = look_of(
      "<geom size='1' material='red'/><geom size='1' material='red' rgba='0 0 1 1'/><geom size='1' material='green'/>"
      "<geom size='1' material='none'/><geom size='1'/>",
      "<material name='red' rgba='1 0 0 1'/><material name='green'/>");
  const auto& v = d.links.back().visuals;
  REQUIRE(v.size() == 5);
  CHECK(v[0].rgba == std::vector<double>{1, 0, 0, 1});
  CHECK(v[1].rgba == std::vector<double>{0, 0, 1, 1});
  CHECK(v[2].rgba == std::vector<double>{0, 1, 0, 1});
  CHECK((v[3].rgba.empty() && v[4].rgba.empty()));
}

}  // namespace mjcf_look_test
