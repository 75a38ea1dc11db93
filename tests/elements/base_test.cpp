#include <kte/kte.hpp>

#include "catch.hpp"
#include "elements/laws.hpp"

namespace base_test {

using namespace kte;

// clang-format off
inline constexpr struct x_    final : coord_key<"x">        {} x;
inline constexpr struct y_    final : coord_key<"y">        {} y;
inline constexpr struct wall_ final : coord_key<"wall">     {} wall;
inline constexpr struct a_    final : frame_2D_key<"a">     {} a;
inline constexpr struct b_    final : frame_2D_key<"b">     {} b;
inline constexpr struct c_    final : frame_3D_key<"c">     {} c;
inline constexpr struct on_a_ final : frame_2D_key<"on a">  {} on_a;
inline constexpr struct on_b_ final : frame_2D_key<"on b">  {} on_b;
inline constexpr struct on_c_ final : frame_3D_key<"on c">  {} on_c;
// clang-format on

constexpr auto masses =
    chain(base_gen(wall), prismatic_joint_2D(x, a, on_a, axis::x), inertia_2D(on_a, point_mass(2.0)), base_2D(b),
          prismatic_joint_2D(y, b, on_b, axis::y), inertia_2D(on_b, point_mass(3.0)), base_3D(c),
          rigid_link_3D(c, on_c, along_z(0.5)), spring_gen(wall, x, 1.0, 10.0))
        .gravity(vec3{-1.0, -9.5, 0.25});

TEST_CASE("a coordinate given from outside is no degree of freedom") {
  STATIC_REQUIRE(decltype(masses)::dofs == 2);
  auto s = make_state(masses);
  s[wall].q = -2.0, s[x].q = 0.5;
  masses.doMotion(s);
  CHECK(s[wall].q == -2.0);  // passes leave it alone
  masses.clearForce(s);
  masses.doForce(s);
  CHECK(s[wall].f == 15.0);
  CHECK(s[x].f == -15.0 - 2.0);  // spring, and gravity along x
  CHECK(forward_dynamics(masses, s)[0] == -8.5);
  CHECK(forward_dynamics(masses, s)[1] == -9.5);
}

TEST_CASE("all bases start accelerated against gravity, and may be moved") {
  auto s = make_state(masses);
  CHECK(s[a].acceleration == vec2{1.0, 9.5});
  CHECK(s[b].acceleration == vec2{1.0, 9.5});
  CHECK(s[c].acceleration == vec3{1.0, 9.5, -0.25});
  s[b].acceleration = {0.0, 9.5 + 4.0};
  s[b].position = {3.0, 0.25};
  s[c].ang_velocity = {2.0, 0.0, 0.0};
  masses.doMotion(s);
  CHECK(s[on_b].position == vec2{3.0, 0.25});
  CHECK(s[on_c].velocity == vec3{0.0, -1.0, 0.0});
  CHECK(s[on_c].acceleration == vec3{1.0, 9.5, -0.25 - 2.0});
  CHECK(forward_dynamics(masses, s)[1] == -13.5);
}

TEST_CASE("a base without a declaration is an error in a runtime chain") {
  runtime_chain chain;
  chain << base_2D("b") << rigid_link_2D("a", "tip", along_x(1.0));
  CHECK_NOTHROW(chain << rigid_link_2D("b", "on b", along_x(1.0)));
  CHECK_THROWS_AS(chain << rigid_link_2D("elsewhere", "end", along_x(1.0)), bad_wiring);
  CHECK_THROWS_AS(chain << base_2D("tip"), bad_wiring);
}

}  // namespace base_test
