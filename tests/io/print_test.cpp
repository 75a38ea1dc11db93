#include <kte/elements/inertia.hpp>
#include <kte/elements/law_spring.hpp>
#include <kte/elements/revolute_joint.hpp>
#include <kte/elements/rigid_link.hpp>
#include <kte/elements/table_spring.hpp>
#include <kte/io/print.hpp>

#include <sstream>

#include "catch.hpp"

namespace print_test {

template <class T>
std::string printed(const T& x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

// clang-format off
inline constexpr struct q_     final : kte::coord_key<"q">       {} q;
inline constexpr struct base_  final : kte::frame_2D_key<"base"> {} base;
inline constexpr struct joint_ final : kte::frame_2D_key<"joint"> {} joint;
inline constexpr struct tip_   final : kte::frame_2D_key<"tip">  {} tip;
// clang-format on
constexpr auto pendulum =
    kte::chain(kte::revolute_joint_2D(q, base, joint), kte::rigid_link_2D(joint, tip, kte::along_x(0.5)),
               kte::inertia_2D(tip, kte::planar_body(1.0, 1.0 / 3).as_published()))
        .gravity(kte::along_y(-9.81));

TEST_CASE("a static chain is printed with its typed constants as literals") {
  CHECK(printed(pendulum) ==
        "static chain of 3 elements, gravity (0_c, -9.81, 0_c)\n"
        "  revolute_joint_2D (coordinate 'q', base 'base', end 'joint'): axis (0_c, 0_c, 1_c)\n"
        "  rigid_link_2D (base 'joint', end 'tip'): position (0.5, 0_c, 0_c), rotation none\n"
        "  inertia_2D (frame 'tip'): mass 1, com (0_c, 0_c, 0_c), inertia (0_c, 0_c, 0_c, 0_c, 0_c, 0.333333), "
        "as_published 1\n");
}

TEST_CASE("a runtime chain is printed as its record is, and functions of the program are said to be there") {
  kte::runtime_chain c;
  c.gravity(kte::along_y(-9.81)) << kte::revolute_joint_2D("q", "base", "joint")
                                 << kte::table_spring_2D("base", "joint", std::vector{0.0, 1.0}, std::vector{0.0, 2.5});
  const std::string elements =
      " of 2 elements, gravity (0, -9.81, 0)\n"
      "  revolute_joint_2D (coordinate 'q', base 'base', end 'joint'): axis (0, 0, 1)\n"
      "  table_spring_2D (anchor1 'base', anchor2 'joint'): lengths (0, 1), forces (0, 2.5)\n";
  CHECK(printed(c) == "runtime chain" + elements);
  const auto record = record_of(c);
  CHECK(printed(record).substr(0, 5) == "model");
  CHECK(printed(record.elements[1]) ==
        "table_spring_2D (anchor1 'base', anchor2 'joint'): lengths (0, 1), forces (0, 2.5)");
  c << kte::law_spring_2D("base", "joint", [](const auto& x) { return 3.0 * x; });
  CHECK_THAT(printed(c), kte::test::contains_text(
                             "  law_spring_2D (anchor1 'base', anchor2 'joint'): a function of the program\n"));
  CHECK(printed(kte::model_record{{}, {{"base_3D", 1, {}, {{"none", {}}}}}}) ==
        "model of 1 element, gravity ()\n  base_3D: none ()\n");
}

TEST_CASE("states are printed by names, of either kind alike") {
  auto s = make_state(pendulum);
  s[q].q = 0.25;
  const std::string text = printed(s);
  CHECK_THAT(text, Catch::StartsWith("q  coordinate  q 0.25, q_dot 0, q_ddot 0, f 0\n"
                                     "base  2D frame  position (0, 0), rotation (cos 1, sin 0), velocity (0, 0), "
                                     "ang_velocity 0, acceleration (0, 9.81), ang_acceleration 0, force (0, 0), "
                                     "torque 0\njoint  2D frame  position"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 4);
  kte::runtime_chain c;
  c << pendulum;
  auto r = c.make_state();
  r.coordinate("q").q = 0.25;
  CHECK(printed(r) == text);
}

TEST_CASE("joint vectors are printed by names; others are refused") {
  CHECK(printed(by_names(pendulum, std::vector{0.125})) == "q  0.125\n");
  CHECK_THROWS_MATCHES(printed(by_names(pendulum, std::vector{1.0, 2.0})), kte::bad_argument,
                       kte::test::says("a joint vector of this chain has 1 numbers (q) or 1 (v), not 2"));
  struct {  // as an int, its length is 1
    std::size_t size() const { return (std::size_t{1} << 32) + 1; }
    double operator[](std::size_t) const { return 0.125; }
  } long_one;
  CHECK_THROWS_WITH(printed(by_names(pendulum, long_one)), kte::test::contains_text("not 4294967297"));
}

TEST_CASE("numbers have the digits of the stream") {
  std::ostringstream out;
  out.precision(3);
  out << kte::vec3{kte::minus_one, 2.0 / 3, kte::zero} << ' ' << kte::quarter_turn_z;
  CHECK(out.str() == "(-1_c, 0.667, 0_c) ((0_c, -1_c, 0_c), (1_c, 0_c, 0_c), (0_c, 0_c, 1_c))");
  CHECK(printed(kte::frame_3D<>{}) ==
        "position (0, 0, 0), rotation ((1, 0, 0), (0, 1, 0), (0, 0, 1)), velocity (0, 0, 0), ang_velocity (0, 0, 0), "
        "acceleration (0, 0, 0), ang_acceleration (0, 0, 0), force (0, 0, 0), torque (0, 0, 0)");
}

}  // namespace print_test
