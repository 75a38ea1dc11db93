#include <kte/runtime_chain/from_record.hpp>

#include "catch.hpp"
#include "chain/elements_page.hpp"
#include "chain/models.hpp"
#include "robots/iiwa14.hpp"

namespace record_test {

using namespace models;
using kte::test::contains_text, kte::test::says;

TEST_CASE("a static chain survives its record, with other numbers too") {
  CHECK(record_of(kte::from_record(tree, record_of(tree))) == record_of(tree));
  CHECK(record_of(kte::from_record(robots::iiwa14, record_of(robots::iiwa14))) == record_of(robots::iiwa14));
  auto heavier = record_of(pendulum);
  heavier.elements[2].parameters[0].values = {3.0};
  const auto c = kte::from_record(pendulum, heavier);
  CHECK(kte::mass_matrix(c, std::array{0.7})(0, 0) == 0.75);  // what is derived from a parameter follows it
}

TEST_CASE("a record that does not fit a static chain says why") {
  const auto good = record_of(pendulum);
  auto bad = good;
  SECTION("another element") {
    bad.elements[1].type = "rigid_link_3D";
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad),
                      contains_text("element 2 (rigid_link_3D)") && contains_text("rigid_link_2D"));
  }
  SECTION("one too few") {
    bad.elements.pop_back();
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("2 elements, the static chain 3"));
  }
  SECTION("another connection") {
    bad.elements[1].connections[0].name = "base";
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("element 2") && contains_text("base 'joint'"));
  }
  SECTION("a number where the type has a constant") {
    bad.elements[1].parameters[0].values[1] = 0.25;
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("position") && contains_text("0.25"));
  }
  SECTION("a rotation where the type has none") {
    bad.elements[1].parameters[1].values = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("rotation"));
  }
  SECTION("too few and too many numbers") {
    bad.elements[1].parameters[0].values.pop_back();
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("too few"));
    bad = good;
    bad.elements[1].parameters[0].values.push_back(0);
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("too many"));
  }
  SECTION("a bad number") {
    bad.elements[2].parameters[0].values = {-1.0};
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad),
                      contains_text("inertia_2D (frame 'tip')") && contains_text("-1"));
  }
  SECTION("another version") {
    bad.elements[0].version = 2;
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("version 2"));
  }
  SECTION("gravity") {
    bad.gravity = {0, -9.81, 0};
    CHECK_THROWS_WITH(kte::from_record(pendulum, bad), contains_text("gravity"));
  }
}

TEST_CASE("the registry knows every element of the library") {
  // Each element that a static chain can hold, made again from its record.
  const auto again = kte::record_of(models::registered(record_of(tree)));
  CHECK(again == record_of(tree));
  using namespace kte;
  runtime_chain flat;
  flat << base_2D("b") << prismatic_joint_2D("x", "b", "cart", vec2{0.6, 0.8})
       << rigid_link_2D("cart", "pivot", vec2{0.1, 0.2}, rotation_by(0.3)) << revolute_joint_2D("q", "pivot", "arm")
       << inertia_2D("arm", planar_body(1.0, 0.2, along_x(0.4))) << base_3D("w") << base_gen("r");
  CHECK(record_of(models::registered(record_of(flat))) == record_of(flat));
}

TEST_CASE("a body as published is so again from its record") {
  using namespace kte;
  const rigid_body odd{1.0, vec3{0.1, 0.2, 0.3}, sym3{1.0, 0.0, 0.0, 1.0, 0.0, 3.0}};
  runtime_chain c;
  c << base_3D("w") << inertia_3D("w", odd.as_published()) << base_2D("b")
    << inertia_2D("b", planar_body(1.0, -0.1).as_published());
  const auto r = record_of(c);
  CHECK(record_of(to_chain(r)) == r);
  CHECK(r.elements[1].parameters.back() == parameter_record{"as_published", {1}});
  auto bad = r;
  bad.elements[1].parameters.back().values = {2};
  CHECK_THROWS_WITH(to_chain(bad), contains_text("element 2: inertia_3D has 'as_published' other than 1"));
  bad.elements[1].parameters.pop_back();
  CHECK_THROWS_WITH(to_chain(bad), contains_text("inertia must be physical"));

  // A static chain takes it from the record, and without it is a body like any other.
  auto published = record_of(pendulum);
  published.elements[2].parameters.push_back({"as_published", {1}});
  CHECK(record_of(from_record(pendulum, published)) == published);
  CHECK(record_of(from_record(from_record(pendulum, published), record_of(pendulum))) == record_of(pendulum));
  published.elements[2].parameters.back().values = {0};
  CHECK_THROWS_WITH(from_record(pendulum, published), contains_text("element 3") && contains_text("must be 1"));
  published.elements[2].parameters.back() = {"colour", {1}};
  CHECK_THROWS_WITH(from_record(pendulum, published), contains_text("element 3") && contains_text("parameters"));
}

TEST_CASE("the registry refuses what it does not understand") {
  const auto make = [](const kte::element_record& r) { return models::registry().make(r); };
  kte::element_record link{"rigid_link_2D",
                           1,
                           {{"base", "a"}, {"end", "b"}},
                           {{"position", {1, 0, 0}}, {"rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1}}}};
  CHECK_NOTHROW(make(link));
  auto bad = link;
  bad.type = "rigid_link_4D";
  CHECK_THROWS_WITH(make(bad), "kte: there is no element type 'rigid_link_4D'");
  bad = link, bad.version = 7;
  CHECK_THROWS_WITH(make(bad), contains_text("version 7"));
  bad = link, bad.connections.pop_back();
  CHECK_THROWS_WITH(make(bad), "kte: rigid_link_2D has no connection 'end'");
  bad = link, bad.connections.push_back({"side", "c"});
  CHECK_THROWS_WITH(make(bad), contains_text("no connection 'side'"));
  bad = link, bad.parameters.pop_back();
  CHECK_THROWS_WITH(make(bad), contains_text("no parameter 'rotation'"));
  bad = link, bad.parameters.push_back({"colour", {1}});
  CHECK_THROWS_WITH(make(bad), contains_text("no parameter 'colour'"));
  bad = link, bad.parameters[0].values = {1, 0};
  CHECK_THROWS_WITH(make(bad), contains_text("2 numbers as 'position', not 3"));
  bad = link, bad.parameters[0].values = {1, 0, 1};
  CHECK_THROWS_WITH(make(bad), contains_text("out of the plane"));
  bad.parameters[0].values[2] = std::nan("");
  CHECK_THROWS_MATCHES(make(bad), kte::bad_parameter, says("position must be finite, got nan"));
  bad = link, bad.parameters[1].values = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  CHECK_THROWS_MATCHES(make(bad), kte::bad_file, says("'rotation' out of the plane"));
  bad.parameters[1].values = {2, 0, 0, 0, 2, 0, 0, 0, 1};
  CHECK_THROWS_MATCHES(make(bad), kte::bad_parameter, says("rotation must be orthonormal"));

  auto registry = models::registry();
  CHECK_THROWS_AS(registry.add("spring_gen",
                               [](const kte::record_reader& r) {
                                 return kte::damper_gen(r.name("anchor1"), r.name("anchor2"), 1.0);
                               }),
                  kte::bad_argument);
}

TEST_CASE("docs/elements.md has every element, every port and every parameter, in their order, and nothing else") {
  const auto registry = kte::element_registry::standard();
  const auto page = elements_page::records();
  std::vector<std::string> described;
  for (const auto& [type, element] : page) {  // the registry refuses what it lacks and what it does not know
    INFO(type);
    described.push_back(type);
    registry.make(element)->for_each_element(
        [&e = element](const kte::kte_element& made) { CHECK(made.record() == e); });
  }
  CHECK(described == registry.types());
}

}  // namespace record_test
