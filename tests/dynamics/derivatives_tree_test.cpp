#include <kte/dynamics/derivatives.hpp>

#include "dynamics/differences.hpp"

// Derivatives of the dynamics of trees with everything whose derivatives are known element by element, with moving
// bases, inputs and given coordinates, against central differences at 50 digits.

namespace derivatives_tree_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::trees;

/// Two trees, on bases that move: branches, all joints in the middle, a joint that is driven by a given coordinate, a
/// coordinate without a joint, and all elements on coordinates.
constexpr auto branches_3D =
    chain(base_gen(drive), base_3D(cart), revolute_joint_3D(q1, base, a, axis::minus_y), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), free_joint_3D(floating, b, c),
          inertia_3D(c, body), spherical_joint_3D(ball, c, d), inertia_3D(d, light),
          prismatic_joint_3D(q2, d, e, axis::x), inertia_3D(e, light),
          revolute_joint_3D(drive, c, f, vec3{0.0, 0.6, 0.8}), inertia_3D(f, body),
          revolute_joint_3D(q3, f, g, vec3{2.0 / 3, -1.0 / 3, 2.0 / 3}), inertia_3D(g, body),
          prismatic_joint_3D(q4, cart, h, axis::z), inertia_3D(h, body), inertia_gen(lone, 2.0), inertia_gen(q3, 0.5),
          spring_gen(q1, q2, 0.25, 20.0), spring_gen(drive, q3, 0.5, 7.0), spring_gen(lone, q4, zero, 3.0),
          damper_gen(q2, q3, 0.25), damper_gen(lone, drive, 0.5), driving_actuator_gen(q3, motor))
        .gravity(fall);

constexpr auto branches_2D =
    chain(revolute_joint_2D(q1, floor_2D, k), inertia_2D(k, planar_body(2.0, 0.25, along_x(0.25))),
          rigid_link_2D(k, l, vec2{0.5, 0.125}, quarter_turn), free_joint_2D(sliding, l, m),
          inertia_2D(m, planar_body(1.5, 0.125, along_y(0.25))), prismatic_joint_2D(q2, m, n, vec2{0.6, 0.8}),
          inertia_2D(n, planar_body(0.5, 0.0625)), base_2D(wall), prismatic_joint_2D(q3, wall, o, axis::y),
          inertia_2D(o, point_mass(0.75)), revolute_joint_2D(q4, n, p),
          inertia_2D(p, planar_body(0.75, 0.125, along_x(0.5))), spring_gen(q2, q3, 0.25, 9.0), damper_gen(q1, q4, 0.5),
          driving_actuator_gen(q2, motor))
        .gravity(along_y(-9.81));

/// Sums along up to six bodies, of numbers up to some times as large as the largest result: measured 1.0e-15.
/// General axes are of length 1 to 1e-16 only, which 50 digits show.
constexpr double most = 3e-15;
/// Some of the condition of M on top: measured 2.5e-14 where all axes are typed.
constexpr double most_of_forward = 1e-13;

template <class Chain, class... Outside>
void check(const Chain& chain, unsigned seed, const Outside&... outside) {
  STATIC_REQUIRE(kte::detail::is_analytical<Chain>);
  constexpr int n = Chain::dofs;
  using vector = joint_vector<double, n>;
  random_numbers random(seed);
  struct {
    double by_q = 0, by_v = 0, by_a = 0, tau = 0;
  } worst;
  for (int round = 0; round < 3; ++round) {
    joint_vector<double, Chain::nq> q;
    vector v, a;
    for (auto& x : q) x = random(3);  // quaternions of any length
    for (auto& x : v) x = random(2);
    for (auto& x : a) x = random(5);
    auto s = make_state(chain);
    auto exact = make_state<big>(chain);
    const auto set = [&](auto& state) {
      set_positions(state, q), set_velocities(state, v), set_accelerations(state, a);
      random_numbers draw(1000 * seed + static_cast<unsigned>(round));
      (move(state[outside], draw), ...);
    };
    set(s), set(exact);

    const auto forces = [&](const auto& t) { return inverse_dynamics(chain, t); };
    const auto by_q = differences(chain, exact, by::q, forces), by_v = differences(chain, exact, by::v, forces),
               by_a = differences(chain, exact, by::a, forces);
    const auto r = inverse_dynamics_derivatives(chain, s);
    note(worst.by_q, gap(r.by_q, by_q)), note(worst.by_v, gap(r.by_v, by_v)), note(worst.by_a, gap(r.by_a, by_a));
    note(worst.tau, gap(r.tau, forces(exact)));
    // Equal to the separate algorithms, up to rounding.
    CHECK(gap(r.tau, forces(s)) < most);
    CHECK(gap(r.by_a, mass_matrix(chain, s)) < most);

    if constexpr (n < 10) {  // takes long to compile
      const auto rates = [&](const auto& t) { return forward_dynamics(chain, t); };
      const auto y = forward_dynamics_derivatives(chain, s);
      CHECK(y.a == rates(s));
      CHECK(gap(y.by_q, differences(chain, exact, by::q, rates)) < most_of_forward);
      CHECK(gap(y.by_v, differences(chain, exact, by::v, rates)) < most_of_forward);
      const joint_matrix<big, n> unity = y.by_tau.template cast<big>() * by_a;
      CHECK(gap(unity, joint_matrix<big, n>(joint_matrix<big, n>::Identity())) < most_of_forward);
    }
  }
  CHECK(worst.by_q < most);
  CHECK(worst.by_v < most);
  CHECK(worst.by_a < most);
  CHECK(worst.tau < most);
}

TEST_CASE("derivatives of a tree in space") { check(branches_3D, 1, base, cart, drive, motor); }
TEST_CASE("derivatives of a tree in the plane") { check(branches_2D, 2, floor_2D, wall, motor); }

}  // namespace derivatives_tree_test
