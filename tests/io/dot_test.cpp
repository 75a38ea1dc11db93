#include <kte/elements/driving_actuator.hpp>
#include <kte/elements/inertia.hpp>
#include <kte/elements/joint_stiction.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/io/dot.hpp>

#include "catch.hpp"

namespace dot_test {

// clang-format off
inline constexpr struct same_  final : kte::coord_key<"same">    {} same;
inline constexpr struct base_  final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct frame_ final : kte::frame_2D_key<"same"> {} frame;
inline constexpr struct motor_ final : kte::input_key<"motor">   {} motor;
// clang-format on

TEST_CASE("graphs have a box for each element and one node for each name of a kind, whichever chain it is") {
  constexpr auto c = kte::chain(kte::revolute_joint_2D(same, base, frame), kte::driving_actuator_gen(same, motor));
  const std::string graph =
      "digraph kte {\n"
      "  rankdir=LR\n"
      "  e0 [shape=box, label=\"revolute_joint_2D\"]\n"
      "  n0 [shape=circle, label=\"same\"]\n"
      "  n0 -> e0 [label=\"coordinate\"]\n"
      "  n1 [shape=ellipse, label=\"base\"]\n"
      "  n1 -> e0 [label=\"base\"]\n"
      "  n2 [shape=ellipse, label=\"same\"]\n"
      "  e0 -> n2 [label=\"end\"]\n"
      "  e1 [shape=box, label=\"driving_actuator_gen\"]\n"
      "  n0 -> e1 [label=\"coordinate\", style=dashed, dir=back]\n"
      "  n3 [shape=diamond, label=\"motor\"]\n"
      "  n3 -> e1 [label=\"input\"]\n"
      "}\n";
  CHECK(to_dot(c) == graph);
  kte::runtime_chain r;
  CHECK(to_dot(r << c) == graph);
}

TEST_CASE("names in graphs are escaped") {
  kte::runtime_chain c;
  c << kte::inertia_gen("a\"b\\n<&lt;\nc", 1.0) << kte::brake_gen("a\"b\\n<&lt;\nc", "z", "f");
  const std::string graph = to_dot(c);
  CHECK_THAT(graph, kte::test::contains_text(R"(label="a\"b\\n<&amp;lt;\nc"])"));
  CHECK_THAT(graph, kte::test::contains_text(R"(n1 -> e1 [label="mode", dir=both])"));
}

}  // namespace dot_test
