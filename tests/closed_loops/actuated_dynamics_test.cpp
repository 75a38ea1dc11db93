#include <kte/control/linearize_loops.hpp>
#include <kte/control/lqr.hpp>

#include <Eigen/Eigenvalues>

#include "catch.hpp"
#include "closed_loops/mechanisms.hpp"
#include "random.hpp"

namespace actuated_dynamics_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::loops;
using Catch::Matchers::Message;

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}
template <class F>
vector difference(const F& f, double h = 2e-4) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// A five-bar with springs and dampers, of mobility 2; it is closed twice.
runtime_chain five_bar() {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << revolute_joint_2D("l1", "base", "a1") << inertia_2D("a1", bar)
                            << rigid_link_2D("a1", "b1", along_x(0.7)) << revolute_joint_2D("l2", "b1", "c1")
                            << inertia_2D("c1", bar) << rigid_link_2D("c1", "d1", along_x(1.0))
                            << revolute_joint_2D("r1", "base", "a2").at(vec2<>{0.8, 0}) << inertia_2D("a2", bar)
                            << rigid_link_2D("a2", "b2", along_x(0.7)) << revolute_joint_2D("r2", "b2", "c2")
                            << inertia_2D("c2", bar) << rigid_link_2D("c2", "d2", along_x(1.0))
                            << coincident_points_2D("pin", "d1", "d2") << coincident_points_2D("again", "d2", "d1")
                            << damper_gen("l1", "l2", 0.3) << spring_2D("base", "d1", 0.5, 20.0);
  return c;
}
const auto driven = actuated("r1", "l1");
const std::array<int, 2> rows{2, 0};

TEST_CASE("equations of motion in actuated coordinates are those of the mechanism") {
  const auto c = five_bar();
  auto s = c.make_state();
  const vector q = assemble(c, s, numbers({2.2, -1.2, 0.9, 1.2}), held("l1", "r1"));
  const Eigen::MatrixXd g = loop_motion(c, s, q, driven);
  const Eigen::Vector2d rate(0.7, -1.1), a_y(2.0, 3.0);
  const vector v = g * rate;

  const vector a = g * a_y + bias_acceleration(c, s, q, v, driven);
  const Eigen::MatrixXd m = mass_matrix(c, s, q, driven);
  const vector bias = nonlinear_effects(c, s, q, v, driven), tau_y = m * a_y + bias;
  CHECK(largest_difference(inverse_dynamics(c, s, q, v, a, driven), tau_y) < 1e-13);
  CHECK(largest_difference(m, m.transpose()) < 1e-15);
  CHECK(0.5 * rate.dot(m * rate) == within(kinetic_energy(c, s, q, v), 1e-13));

  vector tau = vector::Zero(4);
  for (std::size_t k = 0; k < 2; ++k) tau[rows[k]] = tau_y[static_cast<Eigen::Index>(k)];
  CHECK(largest_difference(forward_dynamics(c, s, q, v, tau), a) < 1e-13);

  // the rate of G along the motion
  const vector drift = difference([&](double h) {
    const vector there = assemble(c, s, integrate(c, q, v, h), held("l1", "r1"));
    return vector(loop_motion(c, s, there, driven) * rate);
  });
  CHECK(largest_difference(bias_acceleration(c, s, q, v, driven), drift) < 1e-8);

  const vector slope = difference([&](double h) {
    vector energy(2);
    for (int k = 0; k < 2; ++k) {
      vector there = q;
      there[rows[static_cast<std::size_t>(k)]] += h;
      there = assemble(c, s, there, held("l1", "r1"));
      energy[k] = 4 * 9.81 * centre_of_mass(c, s, there).position.y;
    }
    return energy;
  });
  CHECK(largest_difference(gravity_forces(c, s, q, driven), slope) < 1e-8);
  CHECK(largest_difference(jacobian(c, s, q, "d2", driven) * rate, jacobian(c, s, q, "d2") * v) < 1e-14);
  const vector velocity = jacobian(c, s, q, "d2", in_world_axes, driven) * rate,
               other = jacobian(c, s, q, "d1", in_world_axes, driven) * rate;
  CHECK(largest_difference(velocity.head(3), other.head(3)) < 1e-14);
}

TEST_CASE("a linearization in actuated coordinates equals differences of assembled mechanisms") {
  const auto c = five_bar();
  auto s = c.make_state();
  const vector q = assemble(c, s, numbers({2.2, -1.2, 0.9, 1.2}), held("l1", "r1")),
               v = loop_motion(c, s, q, driven) * Eigen::Vector2d(0.7, -1.1), tau = numbers({1, -2, 3, 0.5});
  const auto linear = linearize(c, s, q, v, tau, driven);
  const auto at = [&](int which, double h) {
    vector there = q, forces = tau;
    Eigen::Vector2d rate(0.7, -1.1);
    if (which < 2) there[rows[static_cast<std::size_t>(which)]] += h;
    if (which >= 2 && which < 4) rate[which - 2] += h;
    if (which >= 4) forces[rows[static_cast<std::size_t>(which - 4)]] += h;
    there = assemble(c, s, there, held("l1", "r1"));
    const vector a = constrained_dynamics(c, s, there, loop_motion(c, s, there, driven) * rate, forces).a;
    return vector(numbers({rate[0], rate[1], a[rows[0]], a[rows[1]]}));
  };
  Eigen::MatrixXd all(4, 6);
  for (int k = 0; k < 6; ++k) all.col(k) = difference([&](double h) { return at(k, h); });
  CHECK(largest_difference(linear.A, all.leftCols(4)) < 1e-8);
  CHECK(largest_difference(linear.B, all.rightCols(2)) < 1e-8);
  CHECK(largest_difference(linear.x_dot, at(0, 0)) < 1e-14);
  const auto gain = lqr(linear, Eigen::Matrix4d::Identity(), Eigen::Matrix2d::Identity());
  const Eigen::MatrixXd closed = linear.A - linear.B * gain.K;
  CHECK(closed.eigenvalues().real().maxCoeff() < 0);
}

TEST_CASE("a parallelogram at its equilibria has the eigenvalues of its one equation of motion") {
  // phi'' = k sin(phi), from the top: +-sqrt(k) there, +-i sqrt(k) below.
  for (const int n : {1, 3}) {
    const auto c = four_bars(n);
    auto s = c.make_state();
    const vector none = vector::Zero(c.dofs());
    const double k = four_bar_constant(n);
    const auto eigenvalues = [&](double phi) -> Eigen::VectorXcd {
      return linearize(c, s, four_bar_q(n, phi), none, none, actuated("q0")).A.eigenvalues();
    };
    const auto top = eigenvalues(0), below = eigenvalues(pi);
    CHECK(std::abs(top[0]) == within(std::sqrt(k), 1e-12));
    CHECK(top.real().cwiseAbs().minCoeff() == within(std::sqrt(k), 1e-12));
    CHECK(below.real().cwiseAbs().maxCoeff() < 1e-12);
    CHECK(below.imag().cwiseAbs().minCoeff() == within(std::sqrt(k), 1e-12));
    // M_y = 4 (N + 1) / 12 + N for bars of 1 m and 1 kg
    const double mass = (n + 1) / 3.0 + n;
    CHECK(mass_matrix(c, s, four_bar_q(n, 0.4), actuated("q0"))(0, 0) == within(mass, 1e-13));
    CHECK(linearize(c, s, four_bar_q(n, 0), none, none, actuated("q0")).B(1, 0) == within(1 / mass, 1e-13));
  }
}

TEST_CASE("a tree is driven by all its coordinates; what cannot be driven is refused") {
  runtime_chain tree;
  tree.gravity(along_y(-9.81)) << revolute_joint_2D("q1", "base", "a") << inertia_2D("a", bar)
                               << rigid_link_2D("a", "b", along_x(1.0)) << revolute_joint_2D("q2", "b", "c")
                               << inertia_2D("c", bar);
  auto s = tree.make_state();
  const vector q = numbers({0.3, 0.5}), v = numbers({1, 2}), tau = numbers({-1, 0.5});
  const auto all = actuated("q1", "q2");
  CHECK(mass_matrix(tree, s, q, all) == mass_matrix(tree, s, q));
  CHECK(nonlinear_effects(tree, s, q, v, all) == nonlinear_effects(tree, s, q, v));
  const auto r = forward_dynamics_derivatives(tree, s, q, v, tau);
  const Eigen::MatrixXd by_q = r.by_q;
  CHECK(largest_difference(linearize(tree, s, q, v, tau, all).A.bottomLeftCorner(2, 2), by_q) < 1e-14);

  const auto c = five_bar();
  auto t = c.make_state();
  const vector on = assemble(c, t, numbers({2.2, -1.2, 0.9, 1.2}), held("l1", "r1"));
  CHECK_THROWS_MATCHES(
      mass_matrix(c, t, on, actuated("l1")), bad_argument,
      Message("kte: this chain has mobility 2 here, so it is driven by as many coordinates, not by 1"));
}

}  // namespace actuated_dynamics_test
