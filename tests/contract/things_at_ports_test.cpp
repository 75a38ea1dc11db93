#include <kte/contract/no_parameters.hpp>
#include <kte/contract/parameter_info.hpp>
#include <kte/contract/things_at_ports.hpp>

#include "catch.hpp"
#include "dynamics/two_hinges.hpp"

namespace things_at_ports_test {

using namespace kte;

/// An element with parameters of several kinds, one of them optional.
struct several {
  static constexpr std::array<std::string_view, 1> optional_parameters{"stiffness"};
  double stiffness = 1;
  bool locked = false;
  vec3<zero_t, zero_t, one_t> axis;
  vec3<> offset;
  std::vector<double> table;

  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness);
    visit("locked", self.locked);
    visit("axis", self.axis);
    visit("offset", self.offset);
    visit("table", self.table);
  }
};
struct none : no_parameters {};

TEST_CASE("parameters of a core by their types") {
  const auto all = parameter_infos<several>();
  REQUIRE(all.size() == 5);
  CHECK((all[0].name == "stiffness" && all[0].what == "number" && all[0].optional && all[0].count == 1));
  CHECK((all[1].what == "flag" && all[1].optional));
  CHECK((all[2].what == "vector" && all[2].is_fixed() && all[2].has_fixed() && !all[2].optional));
  CHECK((!all[3].is_fixed() && !all[3].has_fixed()));
  CHECK((all[4].what == "list" && all[4].count == -1));
  CHECK(all[2].fits(std::array{0.0, 0.0, 1.0}));
  CHECK(!all[2].fits(std::array{0.0, 1.0, 0.0}));
  CHECK(!all[3].fits(std::array{0.0, 1.0}));
  CHECK(all[4].fits(std::array{1.0, 2.0}));
}

TEST_CASE("a core without parameters") {
  CHECK(parameter_infos<none>().empty());
  STATIC_REQUIRE(std::is_empty_v<none>);
}

TEST_CASE("what a core reads and writes at its ports") {
  using namespace detail;
  using hinge = decltype(revolute_joint_2D("q", "base", "end").core);
  using drive = decltype(driving_actuator_gen("q", "u").core);
  STATIC_REQUIRE(coordinates_of<hinge> == 1);
  STATIC_REQUIRE(coordinates_of<test::two_hinges> == 2);
  STATIC_REQUIRE(has_several_coordinates<test::two_hinges>);
  STATIC_REQUIRE(!has_several_coordinates<hinge>);
  STATIC_REQUIRE((writes_frame<hinge> && !writes_coordinate<hinge> && reads_coordinates<hinge>));
  STATIC_REQUIRE(kept_count<hinge> == 0);
  STATIC_REQUIRE(loaded_ports<drive> == 1);  // the coordinate; a signal has no load
  STATIC_REQUIRE(std::is_same_v<sample<kind::vector>::type, vec3<>>);
  STATIC_REQUIRE(std::is_same_v<sample<kind::input>::type, double>);
  STATIC_REQUIRE(load_count<decltype(make_loads(1.0, 2.0))> == 2);
}

}  // namespace things_at_ports_test
