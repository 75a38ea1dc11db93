#include "elements/laws.hpp"

#include <kte/elements/inertial_beam.hpp>
#include <kte/elements/rotor.hpp>
#include <kte/kte.hpp>

#include "catch.hpp"
#include "random.hpp"

namespace laws_test {

using namespace kte;

/// Laws of testing/element_laws.hpp that no element's own test has.

/// A motor with a rotor: it has a mass and a force.
struct motor_with_rotor {
  static constexpr std::string_view type = "motor_with_rotor_gen";
  static constexpr std::array<port, 2> ports{
      {{kind::gen, access::in, "coordinate"}, {kind::input, access::in, "input"}}};
  double inertia, counted;

  template <class C, class U>
  constexpr auto doForce(const C& c, const U& u) const {
    return make_loads(u - inertia * c.q_ddot);
  }
  template <class S>
  constexpr auto mass() const {
    return counted;
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

TEST_CASE("a motor with a mass and an input resists by its mass") {
  random_numbers draw(1);
  const auto right = connect(motor_with_rotor{0.3, 0.3}, "q", "u"),
             wrong = connect(motor_with_rotor{0.3, 0.31}, "q", "u");
  CHECK(testing::mass_is_that_of_force<double>(right, draw) < 1e-15);
  CHECK(testing::mass_is_that_of_force<double>(wrong, draw) > 1e-3);
}

TEST_CASE("masses between several ports") {
  random_numbers draw(2);
  CHECK(testing::distributed_mass_is_that_of_force<double>(rotor_3D("q", "x", axis::y, 30.0, 0.1), draw) < 1e-14);
  CHECK(testing::distributed_mass_is_that_of_force<double>(
            inertial_beam_3D("a", "b", 2.0, sym3{0.2, 0.01, 0.02, 0.3, -0.03, 0.25}), draw) < 1e-14);
  CHECK(testing::distributed_mass_is_that_of_force<double>(inertial_beam_2D("a", "b", 2.0, 0.1), draw) < 1e-14);
}

TEST_CASE("springs and dampers do not care where in the world they are; drag of a flow does") {
  random_numbers draw(3);
  CHECK(testing::same_anywhere<double>(spring_3D("a", "b", 0.3, 50.0), draw) < 1e-13);
  CHECK(testing::same_anywhere<double>(damper_2D("a", "b", 2.0), draw) < 1e-13);
  CHECK(testing::same_anywhere<double>(inertial_beam_3D("a", "b", 2.0), draw) < 1e-13);
  CHECK(testing::same_anywhere<double>(constant_force_3D("a", along_x(1.0)), draw) > 0.1);
}

TEST_CASE("typed constants are the numbers that they say") {
  random_numbers draw(4);
  CHECK(testing::typed_is_plain<double>(revolute_joint_3D("q", "a", "b", axis::x),
                                        revolute_joint_3D("q", "a", "b", as<double>(axis::x)), draw) < 1e-15);
  CHECK(testing::typed_is_plain<double>(spring_3D("a", "b", zero, 3.0), spring_3D("a", "b", 0.0, 3.0), draw) < 1e-15);
  CHECK(testing::typed_is_plain<double>(revolute_joint_3D("q", "a", "b", axis::x),
                                        revolute_joint_3D("q", "a", "b", as<double>(axis::y)), draw) > 1e-3);
}

}  // namespace laws_test
