#include <kte/robots/detail/shape_names.hpp>
#include <kte/robots/load_robot.hpp>

#include "catch.hpp"
#include "robots/files.hpp"
#include "robots/mjcf_texts.hpp"
#include "robots/sdf_texts.hpp"

namespace shape_names_test {

using namespace kte;
using namespace kte::test;
using mjcf_texts::texts;

TEST_CASE("shapes without a name are called by their place among those of their link") {
  robot_description d;
  d.links.resize(2);
  d.links[0].name = "a", d.links[1].name = "b";
  using form = robot_shape::form;
  const auto add = [](std::vector<robot_shape>& to, form is, const std::string& name = "") {
    to.emplace_back().is = is, to.back().name = name;
  };
  auto& seen = d.links[0].visuals;
  for (int i = 0; i < 11; ++i) add(seen, form::box);
  add(seen, form::mesh), add(seen, form::sphere, "ball"), add(seen, form::sphere);
  add(d.links[0].collisions, form::box), add(d.links[1].visuals, form::height_field);
  const detail::shape_names names(d);
  CHECK(names.of(seen[0]) == "first visual box");
  CHECK(names.of(seen[9]) == "tenth visual box");
  CHECK(names.of(seen[10]) == "11. visual box");
  CHECK(names.of(seen[11]) == "visual mesh");
  CHECK(names.of(seen[12]) == "shape 'ball'");
  CHECK(names.of(seen[13]) == "second visual sphere");
  CHECK(names.of(d.links[0].collisions[0]) == "collision box");
  CHECK(names.of(d.links[1].visuals[0]) == "visual height field");
}

TEST_CASE("readers name the second of several shapes without a name, and what is in it") {
  const std::string sphere = "<geometry><sphere radius='1'/></geometry>";
  const auto in_urdf =
      from_urdf(urdf("<link name='a'><visual>" + sphere + "</visual><visual odd='1'/><visual name='v'>" + sphere +
                     "</visual><collision><origin odd='2'/>" + sphere + "</collision></link>"));
  CHECK(texts(in_urdf.not_read) ==
        "link 'a': second <visual>: its odd is not read\nlink 'a': second <visual>: has no <geometry>\n"
        "link 'a': <origin>: its odd is not read\n");
  CHECK_THROWS_MATCHES(
      from_urdf(urdf("<link name='a'><visual/><collision/><collision><origin xyz='1'/></collision></link>"), "a.urdf"),
      bad_file, says("kte: a.urdf:2: link 'a': second <collision>: <origin>: xyz must have three numbers, got 1"));
  CHECK_THROWS_MATCHES(from_mjcf(mjcf_texts::mjcf("<body name='b'><geom size='1'/><geom type='box'/></body>"), "a.xml"),
                       bad_file, says("body 'b': second <geom>: its size must have 3 numbers"));
  CHECK_THROWS_MATCHES(from_mjcf(mjcf_texts::mjcf("<geom size='1'/><geom type='box'/>"), "a.xml"), bad_file,
                       says("kte: a.xml:2: second <geom>: its size must have 3 numbers"));
  CHECK(has(from_sdf(model("<link name='a'><collision>" + sphere + "</collision><collision odd='1'/></link>")).not_read,
            "link 'a': second <collision>: its odd is not read"));
}

}  // namespace shape_names_test
