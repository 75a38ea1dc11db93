#include <cmath>
#include <limits>

#include "catch.hpp"
#include "chain/models.hpp"
#include "robots/iiwa14.hpp"

namespace static_chain_test {

using namespace models;

TEST_CASE("the README's pendulum") {
  constexpr auto c = pendulum.gravity(kte::along_y(-9.81));
  auto s = kte::make_state(c);
  for (const double angle : {0.0, 0.3, -2.0, 3.1}) {
    s[q].q = angle;
    s[q].q_ddot = 0;
    c.doMotion(s);
    c.clearForce(s);
    c.doForce(s);
    s[q].q_ddot = s[q].f / kte::mass_matrix(c, s)(0, 0);
    // q'' = -(g/L) cos q, q from the horizontal. Five roundings at size g/L: 5 eps 20 < 5e-15.
    CHECK(s[q].q_ddot == within(-9.81 / 0.5 * std::cos(angle), 5e-15));
    CHECK(s[tip].position.x == within(0.5 * std::cos(angle), 1e-16));
    CHECK(s[tip].position.y == within(0.5 * std::sin(angle), 1e-16));
  }
}

TEST_CASE("all frames of the pendulum are there to be looked at") {
  auto s = kte::make_state(pendulum.gravity(kte::along_y(-9.81)));
  CHECK(s[base].acceleration == kte::vec2{0.0, 9.81});
  s[q].q = 0.0, s[q].q_dot = 2.0, s[q].q_ddot = 3.0;
  pendulum.doMotion(s);
  CHECK(s[tip].velocity == kte::vec2{0.0, 1.0});              // w L, along the path
  CHECK(s[tip].acceleration == kte::vec2{-2.0, 1.5 + 9.81});  // -w^2 L, and al L in addition to gravity
  CHECK(s[tip].ang_velocity == 2.0);
  pendulum.clearForce(s);
  pendulum.doForce(s);
  CHECK(s[tip].force == kte::vec2{2.0, -11.31});  // -m a
  CHECK(s[q].f == -11.31 * 0.5);
  CHECK(s[base].force == kte::vec2{2.0, -11.31});  // the full wrench reaches the base
  CHECK(s[base].torque == -11.31 * 0.5);
  s[tip].force = {7.0, 0.0};
  pendulum.clearForce(s);
  CHECK(s[tip].force == kte::vec2{0.0, 0.0});
  CHECK(s[q].f == 0.0);
}

TEST_CASE("a static chain is a constexpr value without overhead") {
  using joint_element = std::remove_cvref_t<decltype(boost::hana::at_c<0>(pendulum.elements()))>;
  STATIC_REQUIRE(sizeof(joint_element) == sizeof(joint_element::core_type));
  STATIC_REQUIRE(std::is_trivially_copyable_v<decltype(pendulum)>);
  STATIC_REQUIRE(decltype(pendulum)::dofs == 1);
  STATIC_REQUIRE(decltype(pendulum)::size == 3);
  // The passes themselves run at compile time where no sine is needed.
  constexpr double f = [] {
    constexpr auto c =
        kte::chain(kte::prismatic_joint_2D(q, base, joint, kte::axis::x), kte::inertia_2D(joint, kte::point_mass(2.0)));
    auto s = kte::make_state(c);
    s[q].q_ddot = 3.0;
    c.doMotion(s);
    c.clearForce(s);
    c.doForce(s);
    return s[q].f;
  }();
  STATIC_REQUIRE(f == -6.0);
}

TEST_CASE("chains nest, and the order of degrees of freedom is that of first appearance") {
  using namespace kte;
  constexpr auto leg =
      chain(revolute_joint_3D(hip, left, thigh, axis::y), inertia_3D(thigh, point_mass(1.0, along_z(-0.3))));
  constexpr auto body =
      chain(prismatic_joint_3D(slide, ground, trunk, axis::z), rigid_link_3D(trunk, left, along_y(0.2)));
  constexpr auto nested = chain(body, leg, inertia_3D(trunk, point_mass(5.0)));
  constexpr auto flat = chain(prismatic_joint_3D(slide, ground, trunk, axis::z),
                              rigid_link_3D(trunk, left, along_y(0.2)), revolute_joint_3D(hip, left, thigh, axis::y),
                              inertia_3D(thigh, point_mass(1.0, along_z(-0.3))), inertia_3D(trunk, point_mass(5.0)));
  STATIC_REQUIRE(std::is_same_v<decltype(nested), decltype(flat)>);
  STATIC_REQUIRE(decltype(nested)::dofs == 2);
  CHECK(record_of(nested) == record_of(flat));
  const auto M = mass_matrix(nested, std::array{0.1, 0.0});
  CHECK(M(0, 0) == 6.0);                           // slide first: both masses
  CHECK(M(1, 1) == within_relative(0.09, 4e-16));  // then hip: 1 kg at 0.3 m; three roundings
  CHECK(M(0, 1) == 0.0);                           // a pendulum hanging straight down does not feel up and down
}

TEST_CASE("a chain has the gravity of the first part that has one") {
  using namespace kte;
  constexpr auto arm = pendulum.gravity(along_y(-9.81));
  constexpr auto more = inertia_2D(tip, point_mass(1.0));
  constexpr auto heavier = chain(arm, more);
  STATIC_REQUIRE(std::is_same_v<decltype(heavier.gravity()), decltype(arm.gravity())>);
  STATIC_REQUIRE(heavier.gravity() == arm.gravity());
  STATIC_REQUIRE(pendulum.gravity({0, -9.81, 0}).gravity() == vec3{0.0, -9.81, 0.0});
  STATIC_REQUIRE(decltype(heavier)::size == 4);
  CHECK(make_state(heavier)[base].acceleration == vec2{0.0, 9.81});
  CHECK(record_of(heavier).gravity == std::vector{0.0, -9.81, 0.0});
  CHECK(inverse_dynamics(heavier, std::array{0.0}, std::array{0.0}, std::array{0.0})[0] == 2 * 9.81 * 0.5);

  // a part that comes later; two of the same; zero, typed or not, is none
  constexpr auto loose = chain(more);
  constexpr auto weightless = loose.gravity(vec3{0.0, 0.0, 0.0});
  STATIC_REQUIRE(chain(pendulum, loose.gravity(along_y(-9.81))).gravity() == arm.gravity());
  STATIC_REQUIRE(chain(arm, loose.gravity(along_y(-9.81))).gravity() == arm.gravity());
  STATIC_REQUIRE(chain(arm, weightless).gravity() == vec3{0.0, -9.81, 0.0});
  STATIC_REQUIRE(chain(pendulum.gravity(along_y(0.0)), loose.gravity(along_y(-9.81))).gravity() == arm.gravity());
  STATIC_REQUIRE(chain(pendulum.gravity(vec3{0.0, 0.0, 0.0}), loose.gravity(along_y(-9.81))).gravity() ==
                 vec3{0.0, -9.81, 0.0});
  STATIC_REQUIRE(chain(arm, loose.gravity(vec3{0.0, -9.81, 0.0})).gravity() == vec3{0.0, -9.81, 0.0});
  STATIC_REQUIRE(std::is_same_v<decltype(chain(pendulum, loose).gravity()), const zero3&>);

  // what is written on the whole wins
  STATIC_REQUIRE(heavier.gravity(along_y(-1.62)).gravity() == along_y(-1.62));
  STATIC_REQUIRE(chain(heavier.gravity(zero3{}), loose).gravity() == zero3{});

  CHECK_THROWS_AS(chain(arm, loose.gravity(along_y(-1.62))), bad_wiring);
  CHECK_THROWS_WITH(chain(arm, loose.gravity(along_z(1.5))), kte::test::contains_text("different gravities") &&
                                                                 kte::test::contains_text("(0, -9.8") &&
                                                                 kte::test::contains_text("(0, 0, 1.5)"));
}

TEST_CASE("gravity is finite") {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), -HUGE_VAL}) {
    CHECK_THROWS_AS(pendulum.gravity(kte::along_y(x)), kte::bad_parameter);
    CHECK_THROWS_WITH(pendulum.gravity(kte::vec3{0.0, 1.0, x}),
                      kte::test::contains_text("kte: gravity must be finite"));
    CHECK_THROWS_AS(kte::runtime_chain().gravity(kte::along_y(x)), kte::bad_parameter);
    auto record = record_of(pendulum);
    record.gravity = {0, 0, x};
    CHECK_THROWS_AS(registered(record), kte::bad_parameter);
    CHECK_THROWS_AS(kte::from_record(pendulum.gravity(kte::vec3{0.0, 0.0, 1.0}), record), kte::bad_parameter);
  }
}

TEST_CASE("coordinates of a state are numbered from 0 to their number") {
  auto s = kte::make_state(pendulum);
  CHECK(&s.coordinate(0) == &s[q]);
  CHECK_THROWS_WITH(s.coordinate(7), "kte: there is no generalized coordinate 7 in a state that has 1");
  CHECK_THROWS_AS(s.coordinate(-1), kte::bad_argument);
}

TEST_CASE("degrees of freedom of a tree: followers, fixed coordinates and inputs are none") {
  STATIC_REQUIRE(decltype(tree)::dofs == 3);
  const auto s = kte::make_state(tree);
  CHECK(&s[hip] == &s.coordinate(0));
  CHECK(&s[slide] == &s.coordinate(1));
  CHECK(&s[knee] == &s.coordinate(2));
  CHECK(s[ground].acceleration == kte::vec3{-0.3, 0.4, 9.81});
}

TEST_CASE("states of other scalars") {
  auto s = kte::make_state<float>(pendulum);
  s[q].q = 0.5f;
  pendulum.doMotion(s);
  CHECK(s[tip].position.x == within_relative(0.5f * std::cos(0.5f), 1e-6));
}

TEST_CASE("arguments of the wrong size are named") {
  const std::vector<double> seven(7), six(6);
  CHECK_NOTHROW(kte::inverse_dynamics(robots::iiwa14, seven, seven, seven));
  CHECK_THROWS_WITH(kte::inverse_dynamics(robots::iiwa14, seven, six, seven),
                    "kte: v has 6 numbers, the chain has 7 degrees of freedom");
  CHECK_THROWS_AS(kte::mass_matrix(robots::iiwa14, six), kte::bad_argument);
}

}  // namespace static_chain_test
