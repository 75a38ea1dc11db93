#include <kte/robots/load_robot.hpp>
#include <kte/view.hpp>

#include "catch.hpp"
#include "robots/folder.hpp"

namespace robots_test {

using namespace kte;
using kte::test::contains_text, kte::test::folder;

const std::string tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string urdf = R"(<robot name="crane">
  <link name="base"/>
  <joint name="jib" type="revolute"><parent link="base"/><child link="jib"/><origin xyz="0 0 1" rpy="0 0.5 0"/>
    <axis xyz="0 0 1"/><limit lower="0.25" upper="1" effort="1" velocity="1"/></joint>
  <link name="jib">
    <inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1"/></inertial>
    <visual><geometry><mesh filename="package://crane/meshes/jib.obj" scale="0.5 0.5 0.5"/></geometry>
      <material name="red"><color rgba="1 0 0 0.5"/></material></visual>
    <collision><origin xyz="1 2 3"/><geometry><cylinder radius="0.1" length="2"/></geometry></collision>
  </link>
  <joint name="hook" type="prismatic"><parent link="jib"/><child link="hook"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/><mimic joint="jib" multiplier="2"/></joint>
  <link name="hook"/>
</robot>)";

TEST_CASE("a robot is drawn with its shapes, meshes and ranges, within which it stands") {
  const folder in;
  in.write("crane/meshes/jib.obj", tetra);
  const auto robot = load_robot(in.write("crane/urdf/crane.urdf", urdf));
  const auto s = scene_of(robot);
  CHECK((s.title == "crane" && s.dimension == 3));
  REQUIRE(s.joints.size() == 2);
  CHECK((s.joints[0].name == "jib" && s.joints[0].lower == 0.25 && s.joints[0].upper == 1));
  CHECK(s.joints[0].axis[0] == within(std::sin(0.5), 1e-15));
  CHECK(s.q == std::vector{0.25});
  CHECK(s.recordings.at(0).q == std::vector{0.25f});
  REQUIRE(s.shapes.size() == 2);
  CHECK(
      (s.shapes[0].type == "mesh" && !s.shapes[0].collision && s.shapes[0].colour == std::vector{1.0, 0.0, 0.0, 0.5}));
  CHECK(s.frames[static_cast<std::size_t>(s.shapes[0].frame)].name == "jib");
  CHECK((s.shapes[1].type == "cylinder" && s.shapes[1].collision && s.shapes[1].size == std::vector{0.1, 2.0}));
  CHECK(s.shapes[1].place == scene::pose{1, 2, 3, 1, 0, 0, 0});
  REQUIRE(s.meshes.size() == 1);
  CHECK((s.meshes[0].name == "jib.obj" && s.meshes[0].positions[3] == 0.5f));
  CHECK(s.notes.empty());
  CHECK(!s.model.empty());
}

TEST_CASE("a page of a robot, and of its motion in a table") {
  const folder in;
  const auto robot = load_robot(in.write("crane.urdf", urdf)), other = robot;
  const auto path = in.path / "crane.html";
  write_page(path, robot);
  write_page(path, robot, table{{"t", "jib", "load"}, {{0, 1}, {0.3, 0.4}, {5, 6}}}, {.title = "Crane"});
  scene_recording rec(robot, {.columns = {"hook/position"}});
  auto s = robot.chain.make_state();
  robot.chain.doMotion(s);
  rec.row(0, s);
  write_page(path, rec);
  CHECK_THAT(rec.contents().notes.at(0), contains_text("mesh 'package://crane/meshes/jib.obj' is not drawn"));
  CHECK_THROWS_AS(rec.row(1, runtime_chain(other.chain).gravity({1, 0, 0}).make_state()), bad_argument);
}

TEST_CASE("a robot stands in the first configuration of its file") {
  const folder in;
  auto robot = load_robot(in.write("crane.urdf", urdf));
  robot.configurations = {{"up", {0.75}}, {"down", {0.5}}};
  CHECK(scene_of(robot).q == std::vector{0.75});
}

}  // namespace robots_test
