#include <kte/dynamics/joint_reactions.hpp>

#include <limits>

#include "dynamics/small_chains.hpp"

// What joints carry: a formula, the forces of inverse dynamics, Newton's law for all, static against runtime.

namespace joint_reactions_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

constexpr double eps = std::numeric_limits<double>::epsilon();
/// Sums of loads of bodies below 3 kg along at most 8 poses.
constexpr double rounding = 100 * eps;

Eigen::Matrix<double, 6, 1> eigen(const wrench<vec3<>, vec3<>>& w) {
  return kte::test::small_chains::eigen(linear_angular<double>{w.force, w.torque});
}
template <class Chain, class Frame>
void check_runtime(const Chain& c, const Frame& frame, unsigned seed) {
  const auto model = models::element_by_element(c);
  auto s = model.make_state();
  random_numbers random(seed);
  const random_motion_of<double, Chain> m(c, random);
  const auto w = eigen(joint_reaction(c, m.q, m.v, m.a, frame));
  CHECK(gap(eigen(joint_reaction(model, s, m.q, m.v, m.a, frame.name)), w) < rounding);
  CHECK(gap(eigen(joint_reaction(model, s, model.frame(frame.name))), w) < rounding);
  bool found = false;
  for (const auto& e : joint_reactions(model, s)) {
    if (e.frame != frame.name) continue;
    found = true;
    CHECK(gap(eigen(e.reaction), w) < rounding);
  }
  CHECK(found);
}

TEST_CASE("reaction of a pendulum, by its formula") {
  // 2 kg at 0.5 m: along the rod m (g sin q - l v^2) inward, across it m (g cos q + l a).
  constexpr auto c = chain(revolute_joint_2D(q1, table, cart), inertia_2D(cart, point_mass(2.0, vec3{0.5, 0.0, zero})))
                         .gravity(along_y(-9.81));
  const std::array q{0.3}, v{2.0}, a{1.5};
  const auto w = joint_reaction(c, q, v, a, cart);
  CHECK(w.force.x == within(2 * (9.81 * std::sin(0.3) - 0.5 * 4), 20 * eps));
  CHECK(w.force.y == within(2 * (9.81 * std::cos(0.3) + 0.5 * 1.5), 40 * eps));
  CHECK(w.torque.z == within(inverse_dynamics(c, q, v, a)[0], 40 * eps));
}

TEST_CASE("reactions against inverse dynamics and Newton's law") {
  random_numbers random(1);
  for (int round = 0; round < 5; ++round) {
    const random_motion_of<double, std::remove_const_t<decltype(floating)>> m(floating, random);
    const auto tau = inverse_dynamics(floating, m.q, m.v, m.a);
    const auto at = [&](const auto& frame) { return joint_reaction(floating, m.q, m.v, m.a, frame); };
    CHECK(gap(eigen(at(body)), tau.head<6>()) < rounding);  // of a free joint all is tau
    CHECK(gap(kte::test::small_chains::eigen(at(hand).torque), tau.segment<3>(6)) < rounding);
    CHECK(at(tip).force.y == within(tau[9], 50 * rounding));
    CHECK(at(aside).torque.x == within(tau[10], 50 * rounding));
    // What the ball joint carries, the link before it does too.
    const auto turn = forward_kinematics(floating, m.q, hand).rotation,
               on = forward_kinematics(floating, m.q, socket).rotation;
    CHECK(gap(kte::test::small_chains::eigen(vec3<>(on * at(socket).force)),
              kte::test::small_chains::eigen(vec3<>(turn * at(hand).force))) < rounding);
  }
}

TEST_CASE("reactions of runtime chains") {
  check_runtime(floating_with_springs, hand, 2);
  check_runtime(planar, disc, 3);
  check_runtime(geared, palm, 4);
  check_runtime(models::tree, models::shank, 5);
}

TEST_CASE("reactions of bad arguments") {
  const auto model = models::element_by_element(planar);
  auto s = model.make_state();
  const std::array<double, 4> q{0.1, 0.2, 0.3, 0.4}, nan{1, 2, std::numeric_limits<double>::quiet_NaN(), 4};
  CHECK_THROWS_AS(joint_reaction(model, s, q, q, q, "dsc"), unknown_name);
  CHECK_THROWS_MATCHES(joint_reaction(model, s, q, q, q, "table"), bad_argument,
                       says("no joint or link moves 'table'"));
  CHECK_THROWS_AS(joint_reaction(model, s, q, nan, q, "disc"), bad_argument);
  CHECK_THROWS_AS(joint_reactions(model, s, q, q, nan), bad_argument);
  CHECK_THROWS_AS(joint_reaction(planar, q, q, nan, disc), bad_argument);
  CHECK_THROWS_AS(joint_reaction(planar, q, std::array{1e200, 1e200, 1e200, 1e200}, q, disc), bad_argument);
}

}  // namespace joint_reactions_test
