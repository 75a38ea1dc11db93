#include <kte/robots/load_robot.hpp>
#include <kte/robots/mjcf_writer.hpp>

#include "catch.hpp"
#include "robots/files.hpp"

namespace mjcf_written_shapes_test {

using namespace kte;
using test::holding, test::robot_file;

std::vector<std::string> texts(const std::vector<robot_note>& notes) {
  std::vector<std::string> all;
  for (const auto& n : notes) all.push_back(n.text);
  return all;
}

TEST_CASE("shapes are geoms without mass in MJCF") {
  const auto text = to_mjcf(load_robot(robot_file("several.xml")));
  const auto file = load_mjcf(robot_file("several.xml"));
  const auto again = from_mjcf(text);
  for (const auto& l : file.links) {
    const auto same = [&](const auto& m) { return m.name == l.name; };
    const auto& m = *std::find_if(again.links.begin(), again.links.end(), same);
    REQUIRE(m.visuals.size() == l.visuals.size());
    CHECK(m.collisions.size() == l.collisions.size());
    for (std::size_t i = 0; i < l.visuals.size(); ++i) {
      const auto &x = l.visuals[i], &y = m.visuals[i];
      CHECK((x.name == y.name && x.is == y.is && x.size == y.size && x.origin == y.origin));
      CHECK((x.mesh.empty() ? y.mesh.empty() : std::filesystem::equivalent(x.mesh, y.mesh)));
      CHECK((x.rgba == y.rgba && x.material == y.material));
    }
  }
  robot_description d;
  d.links.reserve(2);
  auto& l = d.links.emplace_back();
  l.name = "a";
  const auto shape = [&l](robot_shape::form is, const vec3<>& size, const std::string& name = {}) -> robot_shape& {
    auto& s = l.visuals.emplace_back();
    s.is = is, s.size = size, s.name = name;
    return s;
  };
  using form = robot_shape::form;
  shape(form::box, {1, 2, 0}, "flat"), shape(form::none, {}), shape(form::plane, {}), shape(form::mesh, {});
  shape(form::sphere, {1, 0, 0}, "ball").rgba = {1, 0, 0}, shape(form::sphere, {2, 0, 0}, "ball").rgba = {1, 0};
  for (const auto* mesh : {"a.STL", "a.STL", "a.dae", "file:///a.stl", "b.obj"}) shape(form::mesh, {}).mesh = mesh;
  l.visuals[l.visuals.size() - 4].scale = {2, 2, 2};
  l.collisions.push_back(l.visuals.back());
  std::vector<robot_note> notes;
  const auto as_it_is = [](const std::string& mesh) { return mesh; };
  CHECK(to_mjcf(d, {.not_written = &notes, .mesh_path = as_it_is}) == holding(R"(
  <asset>
    <mesh name="a.STL" file="a.STL"/>
    <mesh name="a.STL'" file="a.STL" scale="2 2 2"/>
    <mesh name="b.obj" file="b.obj"/>
  </asset>
  <worldbody>
    <body name="a">
      <inertial pos="0 0 0" mass="0" diaginertia="0 0 0"/>
      <geom type="plane" size="0 0 1" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom name="ball" type="sphere" size="1" contype="0" conaffinity="0" group="2" rgba="1 0 0 1" mass="0"/>
      <geom type="sphere" size="2" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="a.STL" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="a.STL'" contype="0" conaffinity="0" group="2" mass="0"/>
      <geom type="mesh" mesh="b.obj" mass="0"/>
    </body>
)"));
  CHECK(texts(notes) ==
        std::vector<std::string>{
            "link 'a': its shape 'flat' is left out: MuJoCo does not accept a size of 0",
            "link 'a': its visual shape is left out: its form is not known",
            "link 'a': its first visual mesh is left out: its mesh '' has no file",
            "link 'a': the name 'ball' of a shape occurs twice, and is omitted",
            "link 'a': its fourth visual mesh is left out: MuJoCo reads stl, obj and msh, not 'a.dae'",
            "link 'a': its fifth visual mesh is left out: MuJoCo accepts paths of meshes, not 'file:///a.stl'"});
  notes.clear();
  const auto only_b = [](const std::string& mesh) { return mesh == "b.obj" ? "meshes/" + mesh : std::string(); };
  CHECK(to_mjcf(d, {.not_written = &notes, .mesh_path = only_b}) ==
        (holding("<mesh name=\"b.obj\" file=\"meshes/b.obj\"/>") && !holding("STL\"")));
  CHECK(notes.size() == 8);
  notes.clear();
  CHECK(to_mjcf(d, {.not_written = &notes}) == !holding("<mesh"));
  CHECK(notes.back().text == "link 'a': its sixth visual mesh is left out: there is no file 'b.obj'");
  // what collides is one with what is seen if all is the same
  const auto groups = [&l, &d](const auto& change) {
    l.visuals.assign(1, {}), l.visuals[0].is = form::sphere, l.visuals[0].size = {1, 0, 0};
    l.collisions = l.visuals;
    change(l.collisions[0]);
    const auto file_text = to_mjcf(d);
    return (file_text.find("group=\"2\"") != file_text.npos) + (file_text.find("group=\"3\"") != file_text.npos);
  };
  CHECK(groups([](robot_shape&) {}) == 0);
  CHECK(groups([](robot_shape& s) { s.name = "x"; }) == 2);
  CHECK(groups([](robot_shape& s) { s.size.x = 2; }) == 2);
  CHECK(groups([](robot_shape& s) { s.is = form::plane; }) == 2);
  CHECK(groups([](robot_shape& s) { s.origin.position.x = 2; }) == 2);
  l.visuals.resize(3), l.visuals[2].is = form::plane;
  l.collisions.clear();
  CHECK(to_mjcf(d) == (!holding("inertial ")));
  d.links.emplace_back().name = "world", d.links[1].visuals = {l.visuals[2]};
  d.joints.emplace_back().name = "q", d.joints[0].parent = "world", d.joints[0].child = "a";
  d.joints[0].is = robot_joint::kind::revolute, d.joints[0].dynamics.armature = 1;
  CHECK(to_mjcf(d) == (holding("<worldbody>\n    <geom type=\"plane\"") &&
                       holding("it is a plane, which MuJoCo accepts only on static bodies")));
}

}  // namespace mjcf_written_shapes_test
