#include "dynamics/trees.hpp"

// Chains whose mass matrix is singular, which articulated bodies must say.

namespace articulated_singular_test {

using namespace kte;
using namespace kte::test::trees;
using models::element_by_element;

/// No state has an answer. Static chains take long to compile: some stand for all.
template <bool AlsoStatic = false, class Chain>
void check_singular(const Chain& chain, unsigned seed) {
  CAPTURE(seed);
  STATIC_REQUIRE(by_articulated_bodies<Chain>);
  random_numbers random(seed);
  const auto model = element_by_element(chain);
  auto s = model.make_state();
  for (int round = 0; round < 30; ++round) {
    const trial<Chain> x(random);
    if constexpr (AlsoStatic) CHECK_THROWS_AS(forward_dynamics(chain, x.q, x.v, x.tau), singular_mass_matrix);
    CHECK_THROWS_AS(forward_dynamics(model, s, x.q, x.v, x.tau), singular_mass_matrix);
  }
}
constexpr auto without_size(double mass) { return rigid_body{mass, zero3{}, sym3<double>{}}; }

TEST_CASE("coordinates that move no independent mass") {
  constexpr auto first = revolute_joint_3D(q1, base, a);
  constexpr auto heavy = inertia_3D(a, body);
  constexpr auto link = rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x);
  SECTION("nothing at the end") {
    check_singular(chain(first), 1);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, axis::x)), 2);
    check_singular<true>(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique)), 3);
    check_singular(chain(first, heavy, link, prismatic_joint_3D(q2, b, c, oblique)), 4);
    check_singular(chain(first, heavy, link, spherical_joint_3D(ball, b, c)), 5);
    check_singular<true>(chain(first, heavy, link, free_joint_3D(floating, b, c)), 6);
    check_singular(
        chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(1.0, 1.0)), free_joint_2D(sliding, k, l)),
        7);
    check_singular<true>(chain(first, heavy, inertia_gen(lone, 0.0)), 8);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), inertia_3D(c, without_size(0.0))),
                   9);
  }
  SECTION("only on the axis") {
    check_singular(chain(first, inertia_3D(a, point_mass(1.0))), 11);
    check_singular<true>(chain(first, inertia_3D(a, point_mass(1.0, along_z(0.75)))), 12);
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), inertia_3D(c, without_size(2.0))),
                   13);
    // away along it
    check_singular(chain(first, heavy, link, revolute_joint_3D(q2, b, c, oblique), rigid_link_3D(c, d, 0.375 * oblique),
                         inertia_3D(d, point_mass(2.0))),
                   14);
    check_singular<true>(
        chain(first, heavy, link, spherical_joint_3D(ball, b, c), inertia_3D(c, point_mass(2.0, along_x(0.5)))), 15);
    check_singular(chain(first, heavy, link, spherical_joint_3D(ball, b, c), inertia_3D(c, point_mass(2.0))), 16);
    check_singular(chain(first, heavy, link, free_joint_3D(floating, b, c),
                         inertia_3D(c, point_mass(2.0, vec3{0.25, 0.5, 0.125}))),
                   17);
    check_singular(chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, point_mass(1.0))), 18);
  }
  SECTION("two joints that do the same") {
    constexpr auto last = inertia_3D(c, body);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a), revolute_joint_3D(q2, a, c), last), 21);
    check_singular(chain(revolute_joint_3D(q1, base, a, axis::x), revolute_joint_3D(q2, a, c, axis::minus_x), last),
                   22);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a, oblique), revolute_joint_3D(q2, a, c, oblique), last),
                         23);
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::y), prismatic_joint_3D(q2, a, c, axis::y), last), 24);
    check_singular(chain(prismatic_joint_3D(q1, base, a, oblique), prismatic_joint_3D(q2, a, c, oblique), last), 25);
    // about z, by a link along it and turned about it
    check_singular(chain(revolute_joint_3D(q1, base, a), rigid_link_3D(a, b, along_z(0.5), quarter_turn_z),
                         revolute_joint_3D(q2, b, c), last),
                   26);
    // about z here, about y there
    check_singular(chain(revolute_joint_3D(q1, base, a), rigid_link_3D(a, b, along_z(0.5), quarter_turn_x),
                         revolute_joint_3D(q2, b, c, axis::y), last),
                   27);
    // parallel sliding joints with a turn between their frames
    check_singular<true>(
        chain(prismatic_joint_3D(q1, base, a, axis::z), rigid_link_3D(a, b, vec3{0.5, 0.25, 1.0}, quarter_turn_x),
              prismatic_joint_3D(q2, b, c, axis::minus_y), last),
        28);
    // three sliding joints in a plane, three revolute ones about two axes
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::x), prismatic_joint_3D(q2, a, b, axis::y),
                         prismatic_joint_3D(q3, b, c, vec3{0.6, 0.8, 0.0}), last),
                   29);
    check_singular(chain(spherical_joint_3D(ball, base, a), revolute_joint_3D(q1, a, c, oblique), last), 30);
    check_singular<true>(chain(revolute_joint_3D(q1, base, a), spherical_joint_3D(ball, a, c), last), 31);
    check_singular<true>(chain(free_joint_3D(floating, base, a), prismatic_joint_3D(q1, a, c, oblique), last), 32);
    check_singular(chain(prismatic_joint_3D(q1, base, a, axis::x), free_joint_3D(floating, a, c), last), 33);
    check_singular<true>(
        chain(free_joint_2D(sliding, floor_2D, k), revolute_joint_2D(q1, k, l), inertia_2D(l, planar_body(1.0, 1.0))),
        34);
  }
  SECTION("not when there is little") {
    // Joints without mass between them that do different things; and small masses.
    constexpr auto cardan = chain(revolute_joint_3D(q1, base, a, axis::x), revolute_joint_3D(q2, a, b, axis::y),
                                  revolute_joint_3D(q3, b, c, oblique), inertia_3D(c, body));
    const std::array some{0.25, 0.5, 0.75};
    CHECK_NOTHROW(forward_dynamics(cardan, some, some, some));
    constexpr auto tiny =
        chain(revolute_joint_3D(q1, base, a, oblique), inertia_3D(a, body), rigid_link_3D(a, b, along_x(0.5)),
              revolute_joint_3D(q2, b, c), inertia_3D(c, point_mass(1e-12, along_x(1e-3))));
    const std::array two{0.25, 0.5};
    CHECK_NOTHROW(forward_dynamics(tiny, two, two, two));
    const auto model = element_by_element(tiny);
    auto s = model.make_state();
    CHECK_NOTHROW(forward_dynamics(model, s, two, two, two));
  }
}

}  // namespace articulated_singular_test
