#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/elements/dry_revolute_joint.hpp>
#include <kte/elements/joint_stiction.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>

#include "dynamics/small_chains.hpp"

// Derivatives where joints have friction by what they carry, and so by accelerations: against differences at 50 digits,
// and of static chains against those of runtime chains.

namespace derivatives_friction_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

/// An arm on a floating body with two such joints, one on the other.
constexpr auto arm =
    chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
          dry_revolute_joint_3D(q1, body, socket, axis::y, 0.02, 0.1).at(vec3{0.3, 0.1, -0.2}, quarter_turn_y),
          inertia_3D(socket, stick), dry_revolute_joint_3D(q2, socket, hand, axis::x, 0.03, 0.2),
          inertia_3D(hand, stick), spring_3D(ground, hand, 0.2, 30.0))
        .gravity(weight);
using motion_type = random_motion_of<big, std::remove_const_t<decltype(arm)>>;

TEST_CASE("derivatives of inverse dynamics under friction by load") {
  random_numbers random(1);
  const motion_type m(arm, random);
  const auto r = inverse_dynamics_derivatives(arm, m.q, m.v, m.a);
  CHECK(gap(r.tau, inverse_dynamics(arm, m.q, m.v, m.a)) < 1e-45);
  using vector = std::remove_const_t<decltype(m.v)>;
  for (int j = 0; j < arm.dofs; ++j) {
    const vector along = vector::Unit(j);
    const auto by_q =
        derivative([&](const big& t) { return inverse_dynamics(arm, integrate(arm, m.q, along, t), m.v, m.a); });
    const auto by_v =
        derivative([&](const big& t) { return inverse_dynamics(arm, m.q, vector(m.v + t * along), m.a); });
    const auto by_a =
        derivative([&](const big& t) { return inverse_dynamics(arm, m.q, m.v, vector(m.a + t * along)); });
    CHECK(gap(vector(r.by_q.col(j)), by_q) < by_differences);
    CHECK(gap(vector(r.by_v.col(j)), by_v) < by_differences);
    CHECK(gap(vector(r.by_a.col(j)), by_a) < by_differences);
  }
  CHECK(gap(r.by_a, mass_matrix(arm, m.q)) > 1e-4);  // which is not all of it
}

TEST_CASE("derivatives of forward dynamics under friction by load") {
  random_numbers random(2);
  const motion_type m(arm, random);
  using vector = std::remove_const_t<decltype(m.v)>;
  const auto& tau = m.a;
  const auto r = forward_dynamics_derivatives(arm, m.q, m.v, tau);
  CHECK(gap(inverse_dynamics(arm, m.q, m.v, r.a), tau) < 1e-44);
  // Accelerations are found to some 1e-47 of their size, 1e3 of them in differences with a step of 1e-12.
  const auto check = [](const auto& exact, const auto& f) {
    CHECK(gap(vector(exact), derivative(f)) < by_differences);
  };
  for (int j = 0; j < arm.dofs; ++j) {
    const vector along = vector::Unit(j);
    check(r.by_q.col(j), [&](const big& t) { return forward_dynamics(arm, integrate(arm, m.q, along, t), m.v, tau); });
    check(r.by_v.col(j), [&](const big& t) { return forward_dynamics(arm, m.q, vector(m.v + t * along), tau); });
    check(r.by_tau.col(j), [&](const big& t) { return forward_dynamics(arm, m.q, m.v, vector(tau + t * along)); });
  }
}

TEST_CASE("derivatives under friction by load of runtime chains") {
  const auto model = models::element_by_element(arm);
  auto s = model.make_state();
  random_numbers random(3);
  for (int round = 0; round < 5; ++round) {
    const random_motion_of<double, std::remove_const_t<decltype(arm)>> m(arm, random);
    const auto x = inverse_dynamics_derivatives(arm, m.q, m.v, m.a);
    const auto& y = inverse_dynamics_derivatives(model, s, m.q, m.v, m.a);
    CHECK(gap(y.tau, x.tau) < 1e-13);
    CHECK(gap(y.by_q, x.by_q) < 1e-13);
    CHECK(gap(y.by_v, x.by_v) < 1e-13);
    CHECK(gap(y.by_a, x.by_a) < 1e-13);
    const auto a = forward_dynamics_derivatives(arm, m.q, m.v, m.a);
    const auto& b = forward_dynamics_derivatives(model, s, m.q, m.v, m.a);
    CHECK(gap(b.a, a.a) < 1e-12);
    CHECK(gap(b.by_q, a.by_q) < 1e-12);
    CHECK(gap(b.by_v, a.by_v) < 1e-12);
    CHECK(gap(b.by_tau, a.by_tau) < 1e-12);
  }
}

TEST_CASE("derivatives under friction by load where a coordinate is held") {
  runtime_chain c;
  c.gravity(weight) << dry_revolute_joint_3D("q1", "ground", "upper", axis::y, 0.05, 0.1) << inertia_3D("upper", brick)
                    << revolute_joint_3D("q2", "upper", "fore", axis::x) << inertia_3D("fore", stick)
                    << joint_stiction_gen("q2", "mode", {.coulomb = 2.0, .stiction = 3.0})
                    << dry_revolute_joint_3D("q3", "fore", "hand", axis::y, 0.02, 0.1) << inertia_3D("hand", stick);
  auto s = c.make_state();
  s.internal("mode").z = mode::held;
  const Eigen::Vector3d q(0.3, -0.5, 0.7), v(1.0, 0.0, -2.0), tau(3.0, -1.0, 0.5);
  const auto r = forward_dynamics_derivatives(c, s, q, v, tau);
  CHECK(r.a[1] == 0.0);
  CHECK(r.by_tau.row(1).isZero(0));
  CHECK(r.by_tau.col(1).isZero(0));
  // Differences: h^2/6 of third derivatives, which are below 1e4, and some 1e-13/h.
  const double h = 1e-6;
  const auto by = [h](const auto& f) { return Eigen::Vector3d((f(h) - f(-h)) / (2 * h)); };
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(j);
    const auto at = [&](const auto& x, const auto& y, const auto& z) {
      return Eigen::Vector3d(forward_dynamics(c, s, Eigen::Vector3d(x), Eigen::Vector3d(y), Eigen::Vector3d(z)));
    };
    CHECK(gap(Eigen::Vector3d(r.by_q.col(j)), by([&](double t) { return at(q + t * along, v, tau); })) < 1e-6);
    CHECK(gap(Eigen::Vector3d(r.by_tau.col(j)), by([&](double t) { return at(q, v, tau + t * along); })) < 1e-6);
  }
}

}  // namespace derivatives_friction_test
