#include <kte/dynamics/derivatives.hpp>

#include "dynamics/differences.hpp"

// Derivatives by dual numbers, in chains where some elements are known by their forces alone; both ways against each
// other; forward dynamics too against central differences at 50 digits. Measured 1.3e-15 of the largest number for
// inverse dynamics, 7e-16 for forward dynamics; bounds are 3 to 4 times that.

namespace derivatives_dual_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::trees;

constexpr auto joints =
    chain(revolute_joint_3D(q1, base, a, axis::minus_y), inertia_3D(a, body),
          rigid_link_3D(a, b, vec3{0.25, 0.5, -0.375}, quarter_turn_x), spherical_joint_3D(ball, b, c),
          inertia_3D(c, body), prismatic_joint_3D(q2, c, d, axis::x), inertia_3D(d, light),
          spring_gen(q1, q2, 0.25, 20.0), damper_gen(q1, q2, 0.25));
/// Analytical.
constexpr auto arm = joints.gravity(fall);
/// Not: forces between frames.
constexpr auto sprung = chain(joints, spring_3D(base, d, 0.5, 40.0), damper_3D(base, c, 0.75)).gravity(fall);

/// Sets equal random q, v, a in two states.
template <class State>
auto put_random(State& s, auto& exact, unsigned seed) {
  random_numbers random(seed);
  using wiring = typename State::wiring;
  joint_vector<double, wiring::nq> q;
  joint_vector<double, wiring::dofs> v, a;
  for (auto& x : q) x = random(3);
  for (auto& x : v) x = random(2);
  for (auto& x : a) x = random(5);
  set_positions(s, q), set_velocities(s, v), set_accelerations(s, a);
  set_positions(exact, q), set_velocities(exact, v), set_accelerations(exact, a);
  return std::tuple{q, v, a};
}

template <class Chain, class... Outside>
void check(const char* name, const Chain& chain, double most_of_inverse, double most_of_forward,
           const Outside&... outside) {
  STATIC_REQUIRE(!kte::detail::is_analytical<Chain>);
  constexpr int n = Chain::dofs;
  struct {
    double by_q = 0, by_v = 0, by_a = 0, tau = 0, forward_by_q = 0, forward_by_v = 0, by_tau = 0;
  } worst;
  for (unsigned round = 0; round < 3; ++round) {
    auto s = make_state(chain);
    auto exact = make_state<big>(chain);
    put_random(s, exact, 10 + round);
    random_numbers draw(100 + round), same(100 + round);
    (move(s[outside], draw), ...), (move(exact[outside], same), ...);

    const auto forces = [&](const auto& t) { return inverse_dynamics(chain, t); };
    const auto r = inverse_dynamics_derivatives(chain, s);
    const auto by_a = differences(chain, exact, by::a, forces);
    note(worst.by_q, gap(r.by_q, differences(chain, exact, by::q, forces)));
    note(worst.by_v, gap(r.by_v, differences(chain, exact, by::v, forces)));
    note(worst.by_a, gap(r.by_a, by_a));
    note(worst.tau, gap(r.tau, forces(exact)));

    const auto rates = [&](const auto& t) { return forward_dynamics(chain, t); };
    const auto f = forward_dynamics_derivatives(chain, s);
    CHECK(f.a == rates(s));
    note(worst.forward_by_q, gap(f.by_q, differences(chain, exact, by::q, rates)));
    note(worst.forward_by_v, gap(f.by_v, differences(chain, exact, by::v, rates)));
    const auto identity = joint_matrix<big, n>::Identity();
    const joint_matrix<big, n> unity = f.by_tau.template cast<big>() * by_a;
    note(worst.by_tau, gap(unity, joint_matrix<big, n>(identity)));
  }
  CAPTURE(name);
  CHECK(worst.by_q < most_of_inverse);
  CHECK(worst.by_v < most_of_inverse);
  CHECK(worst.by_a < most_of_inverse);
  CHECK(worst.tau < most_of_inverse);
  CHECK(worst.forward_by_q < most_of_forward);
  CHECK(worst.forward_by_v < most_of_forward);
  CHECK(worst.by_tau < most_of_forward);
}

TEST_CASE("derivatives of a chain with springs between frames") { check("sprung", sprung, 4e-15, 3e-15, base); }
TEST_CASE("derivatives where coordinates follow others and move two joints") {
  check("tree", models::tree, 4e-15, 3e-15, models::ground, models::wall, models::motor);
}

TEST_CASE("element by element as by dual numbers") {
  STATIC_REQUIRE(kte::detail::is_analytical<std::remove_const_t<decltype(arm)>>);
  auto s = make_state(arm), t = s;
  for (unsigned round = 0; round < 10; ++round) {
    const auto [q, v, a] = put_random(s, t, round);
    const auto r = inverse_dynamics_derivatives(arm, q, v, a);
    inverse_dynamics_result<double, 5> x;
    kte::detail::dual_derivatives<double>(arm, kte::detail::base_under_gravity(arm), q, v, a, x);
    CHECK(gap(r.tau, x.tau) < 2e-15);
    CHECK(gap(r.by_q, x.by_q) < 3e-15);
    CHECK(gap(r.by_v, x.by_v) < 3e-15);
  }
}

}  // namespace derivatives_dual_test
