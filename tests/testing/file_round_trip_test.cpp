#include <kte/testing/file_round_trip.hpp>

#include "catch.hpp"
#include "chain/elements_page.hpp"
#include "chain/registered.hpp"
#include "random.hpp"

namespace file_round_trip_test {

using namespace kte;

/// The record with other numbers, all different, if the element accepts them.
element_record with_odd_numbers(const element_registry& registry, const element_record& plain) {
  element_record r = plain;
  double odd = 1;
  for (auto& p : r.parameters)
    for (double& x : p.values) {
      const double before = std::exchange(x, odd += 0.0625);
      try {
        (void)registry.make(r);
      } catch (const error&) {
        x = before;
      }
    }
  return r;
}

/// A spring whose record leaves one number out.
struct forgetful_spring {
  static constexpr std::string_view type = "forgetful_spring_gen";
  static constexpr std::array<port, 1> ports{{{kind::gen, access::on, "coordinate"}}};
  double stiffness, force;
  template <class C>
  constexpr auto doForce(const C& c) const {
    return make_loads(force - stiffness * c.q);
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("stiffness", self.stiffness);
  }
};
auto forgetful(double stiffness, double force) { return connect(forgetful_spring{stiffness, force}, "q"); }

TEST_CASE("all elements of the library come back from files unchanged") {
  random_numbers draw(1);
  int odd = 0;
  for (const auto& [type, plain] : elements_page::records()) {
    INFO(type);
    const auto record = with_odd_numbers(models::registry(), plain);
    odd += record != plain;
    models::registry().make(record)->for_each_element([&](const kte_element& e) {
      CHECK(e.record() == record);
      CHECK(testing::file_round_trip(e, models::registry(), draw) == 0);
    });
  }
  CHECK(odd > 50);
}

TEST_CASE("typed constants come back from files as numbers") {
  random_numbers draw(2);
  const auto check = [&draw](const auto& e) { CHECK(testing::file_round_trip(e, models::registry(), draw) == 0); };
  check(revolute_joint_3D("q", "a", "b", axis::y).at(along_z(0.5), quarter_turn_x));
  check(rigid_link_2D("a", "b", along_x(0.5), quarter_turn));
  check(damper_3D("a", "b", 2.0));
  // Which takes another way to its force, to the same numbers but for rounding.
  CHECK(testing::file_round_trip(spring_3D("a", "b", zero, 50.0), models::registry(), draw) < 0.1);
}

TEST_CASE("an element that leaves a number out of its record, or that is read as another") {
  random_numbers draw(3);
  auto registry = models::registry();
  CHECK_THROWS_AS(testing::file_round_trip(forgetful(2, 1), registry, draw), bad_file);
  registry.add("forgetful_spring_gen", [](const record_reader& r) { return forgetful(r.number("stiffness"), 0); });
  CHECK(testing::file_round_trip(forgetful(2, 0), registry, draw) == 0);
  CHECK(testing::file_round_trip(forgetful(2, 1), registry, draw) > 0);
  auto other = models::registry();
  other.add("forgetful_spring_gen", [](const record_reader& r) { return forgetful(2 * r.number("stiffness"), 0); });
  CHECK(testing::file_round_trip(forgetful(2, 0), other, draw) == 1);
}

}  // namespace file_round_trip_test
