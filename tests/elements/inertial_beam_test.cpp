#include <kte/dynamics.hpp>
#include <kte/elements/flexible_beam.hpp>
#include <kte/elements/inertial_beam.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "chain/registered.hpp"
#include "elements/laws.hpp"

namespace inertial_beam_test {

using namespace kte;

TEST_CASE("a beam with a consistent mass moves as a rigid bar between stiff ends") {
  // a bar of 3 kg and 0.8 m on a hinge: m L^2/3, half of its weight on the tip
  runtime_chain c;
  c << revolute_joint_3D("q", "ground", "root", axis::y) << rigid_link_3D("root", "tip", along_x(0.8))
    << inertial_beam_3D("root", "tip", 3.0);
  c.gravity(along_z(-9.81));
  auto s = c.make_state();
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.3), v = Eigen::VectorXd::Constant(1, 2.0),
                        none = Eigen::VectorXd::Zero(1);
  CHECK(mass_matrix(c, s, q)(0, 0) == within(3 * 0.64 / 3, 1e-15));
  CHECK(inverse_dynamics(c, s, q, v, none)[0] == within(-3 * 9.81 * 0.4 * std::cos(0.3), 1e-14));
  CHECK(forward_dynamics(c, s, q, v, none)[0] == within(3 * 9.81 * 0.4 * std::cos(0.3) / 0.64, 1e-13));
  const auto e = energy(c, s, q, v);
  CHECK(e.kinetic == within(0.5 * 0.64 * 4, 1e-15));
  CHECK(e.potential == within(-3 * 9.81 * 0.4 * std::sin(0.3), 1e-14));
  CHECK_THROWS_AS(centre_of_mass(c, s, q), bad_argument);
}

/// Two arms of joints from the ground, and a beam between their ends.
runtime_chain two_arms() {
  runtime_chain c;
  c << revolute_joint_3D("q1", "ground", "a1", axis::z) << prismatic_joint_3D("q2", "a1", "a2", axis::x)
    << revolute_joint_3D("q3", "a2", "a3", axis::y) << revolute_joint_3D("q4", "a3", "a", axis::x)
    << rigid_link_3D("ground", "b0", vec3{0.9, 0.3, -0.2}) << revolute_joint_3D("q5", "b0", "b1", axis::y)
    << prismatic_joint_3D("q6", "b1", "b2", axis::z) << revolute_joint_3D("q7", "b2", "b3", axis::x)
    << revolute_joint_3D("q8", "b3", "b", axis::z)
    << inertial_beam_3D("a", "b", 2.0, sym3{0.2, 0.01, 0.02, 0.3, -0.03, 0.25});
  c.gravity(vec3{1.0, -2.0, -9.81});
  return c;
}

TEST_CASE("the loads of a beam's mass are those of its energy by Lagrange's equations") {
  const auto c = two_arms();
  auto s = c.make_state();
  const int n = c.dofs();
  random_numbers draw(3);
  const auto vector = [&] { return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(n, [&] { return draw(); })); };
  const Eigen::VectorXd q = vector(), v = vector(), a = vector();
  const auto kinetic = [&](const Eigen::VectorXd& at, const Eigen::VectorXd& rates) {
    return energy(c, s, at, rates).kinetic;
  };
  const Eigen::MatrixXd m = mass_matrix(c, s, q);
  CHECK(kinetic(q, v) == within(0.5 * v.dot(m * v), 1e-14));
  // d/dt (M v) - dT/dq + dV/dq
  const auto slope = [](const auto& f) {
    const double h = 1e-3;
    return ((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
  };
  Eigen::VectorXd tau = m * a;
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(n, i);
    tau[i] += slope([&](double t) { return e.dot(mass_matrix(c, s, q + t * v) * v); });
    tau[i] -= slope([&](double t) { return kinetic(q + t * e, v) - energy(c, s, q + t * e, v).potential; });
  }
  CHECK((inverse_dynamics(c, s, q, v, a) - tau).norm() < 1e-9);
}

TEST_CASE("the mass of a beam in the plane and in space") {
  random_numbers draw(4);
  const auto flat = inertial_beam_2D("a", "b", 2.0, 0.1);
  const auto solid = inertial_beam_3D("a", "b", 2.0, diagonal(0.0, 0.0, 0.1));
  CHECK(test::planar_difference<double>(flat, solid, draw) < test::rounding<double>);
  CHECK(test::planar_difference<test::digits50>(flat, solid, draw) < test::rounding<test::digits50>);
}

/// Angular frequencies at rest at q of a chain that is held by what its base stands on, lowest first.
std::vector<double> frequencies(const runtime_chain& c, const Eigen::VectorXd& q) {
  auto s = c.make_state();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(c.dofs());
  const Eigen::MatrixXd stiffness = inverse_dynamics_derivatives(c, s, q, none, none).by_q, m = mass_matrix(c, s, q);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, m);
  std::vector<double> w;
  for (const double x : modes.eigenvalues()) w.push_back(std::sqrt(x));
  return w;
}
/// A cantilever of n beams in the plane: length 1, EI = 1, mass 1.
runtime_chain cantilever(int n, double EA) {
  runtime_chain c;
  std::string before = "wall";
  for (int i = 1; i <= n; ++i) {
    const std::string node = std::to_string(i);
    c << free_joint_2D("at " + node, "wall", node)
      << flexible_beam_2D(before, node, 1.0 / n, planar_beam_section{.EA = EA, .EI = 1.0})
      << inertial_beam_2D(before, node, 1.0 / n);
    before = node;
  }
  return c;
}
Eigen::VectorXd straight(int n) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(3 * n);
  for (int i = 0; i < n; ++i) q[3 * i] = (i + 1.0) / n;
  return q;
}
/// A rod of n beams that only turn about it (k = GJ), or only move along it (k = EA), clamped at one end; of mass or
/// inertia 1, length 1.
runtime_chain rod(int n, bool turns) {
  runtime_chain c;
  std::string before = "wall";
  const double l = 1.0 / n;
  for (int i = 1; i <= n; ++i) {
    const std::string node = std::to_string(i), place = "place " + node;
    c << rigid_link_3D("wall", place, along_x(l * i));
    if (turns) {
      c << revolute_joint_3D("q" + node, place, node, axis::x);
    } else {
      c << prismatic_joint_3D("q" + node, place, node, axis::x);
    }
    c << flexible_beam_3D(before, node, l, {.EA = 1, .EI_y = 1, .EI_z = 1, .GJ = 1})
      << inertial_beam_3D(before, node, l, diagonal(l / 2, zero, zero));
    before = node;
  }
  return c;
}
/// The order at which errors fall, of two at numbers of elements that double.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

TEST_CASE("frequencies of a cantilever are those of Euler and Bernoulli, to sixth order") {
  const std::array roots{1.8751040687119612, 4.694091132974174, 7.854757438237612};  // of cos x cosh x = -1
  const auto errors = [&](int n) {
    const auto w = frequencies(cantilever(n, 1e5), straight(n));
    return std::array{w[0] / (roots[0] * roots[0]) - 1, w[1] / (roots[1] * roots[1]) - 1,
                      w[2] / (roots[2] * roots[2]) - 1};
  };
  const auto e4 = errors(4), e8 = errors(8), e16 = errors(16);
  CHECK(std::abs(e4[0]) < 3e-6);
  CHECK(std::abs(e4[2]) < 9e-3);
  CHECK(std::abs(e8[2]) < 1.3e-4);
  CHECK(std::abs(e16[2]) < 2e-6);
  CHECK(order(e4[1], e8[1]) == within(6, 0.1));
  CHECK(order(e8[2], e16[2]) == within(6, 0.1));
}

TEST_CASE("frequencies of a rod along and in torsion, to fourth order") {
  for (const bool turns : {false, true}) {
    const auto error = [&](int n, int mode) {
      return frequencies(rod(n, turns), Eigen::VectorXd::Zero(n))[static_cast<std::size_t>(mode)] /
                 ((mode + 0.5) * std::numbers::pi) -
             1;
    };
    CHECK(std::abs(error(4, 0)) < 2e-4);
    CHECK(order(error(4, 0), error(8, 0)) == within(4, 0.1));
    CHECK(order(error(8, 1), error(16, 1)) == within(4, 0.1));
  }
}

TEST_CASE("frequencies of a beam that turns, which its pull makes stiffer") {
  // Across the plane, in units of EI, m and L, at 12 rad/s, by power series (as Wright, Smith, Thresher, Wang, J. Appl.
  // Mech. 49 (1982)); in the plane of the turn w^2 is less by 12^2, but for Coriolis forces, some of 12^2/EA.
  const double first = 13.170150487506177, second = 37.603112331191866;
  const auto squares = [](int n) {
    runtime_chain c;
    c << revolute_joint_2D("turn", "ground", "wall") << cantilever(n, 1e8);
    auto s = c.make_state();
    Eigen::VectorXd q = Eigen::VectorXd::Zero(c.nq()), v = Eigen::VectorXd::Zero(c.dofs()), none = v;
    q.tail(3 * n) = straight(n), v[0] = 12;
    Eigen::MatrixXd k;
    for (int i = 0; i < 4; ++i) {  // to where it is at rest
      const auto& d = inverse_dynamics_derivatives(c, s, q, v, none);
      k = d.by_q.bottomRightCorner(3 * n, 3 * n);
      const Eigen::VectorXd step = k.lu().solve(d.tau.tail(3 * n));
      q.tail(3 * n) -= step;
    }
    const Eigen::MatrixXd m = mass_matrix(c, s, q).bottomRightCorner(3 * n, 3 * n);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(Eigen::MatrixXd((k + k.transpose()) / 2), m);
    return std::array{modes.eigenvalues()[0] + 144, modes.eigenvalues()[1] + 144};
  };
  const auto error = [](double square, double exact) { return std::sqrt(square) / exact - 1; };
  const auto w4 = squares(4), w8 = squares(8);
  CHECK(std::abs(error(w8[0], first)) < 1e-4);
  CHECK(std::abs(error(w8[1], second)) < 1e-4);
  CHECK(order(error(w4[0], first), error(w8[0], first)) == within(4, 0.4));
}

TEST_CASE("the spin-up of Kane, Ryan and Banerjee", "[long]") {
  // EA = 2.8e7, EI = 1.4e4, 1.2 kg/m, 10 m, from rest to 6 rad/s in 15 s (Simo and Vu-Quoc, J. Appl. Mech. 53 (1986)),
  // by the trapezoidal rule; the tip lags most by 0.573787 (16 beams, RK4 of 9e-5 s), linear masses err
  // by 1.8e-3.
  constexpr int n = 8;
  constexpr double L = 10, speed = 6, end = 15, dt = 0.02;
  runtime_chain c;
  c << revolute_joint_2D("turn", "ground", "0");
  for (int i = 1; i <= n; ++i) {
    const auto node = std::to_string(i), before = std::to_string(i - 1);
    c << rigid_link_2D("0", "o" + node, along_x(L * i / n))
      << prismatic_joint_2D("x" + node, "o" + node, "a" + node, axis::x)
      << prismatic_joint_2D("y" + node, "a" + node, "b" + node, axis::y)
      << revolute_joint_2D("r" + node, "b" + node, node)
      << flexible_beam_2D(before, node, L / n, {.EA = 2.8e7, .EI = 1.4e4})
      << inertial_beam_2D(before, node, 1.2 * L / n);
  }
  auto s = c.make_state();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(c.dofs()), v = q, a = q;
  const auto free = Eigen::seqN(1, 3 * n);
  double most = 0;
  for (int step = 1; step * dt < 7; ++step) {
    const double angle = 2 * std::numbers::pi * step * dt / end;
    const Eigen::VectorXd q_0 = q + dt * v + dt * dt / 4 * a, v_0 = v + dt / 2 * a;
    const auto step_by = [&] {
      q = q_0 + dt * dt / 4 * a, v = v_0 + dt / 2 * a;
      q[0] = speed * end * (angle * angle / 2 + std::cos(angle) - 1) / (4 * std::numbers::pi * std::numbers::pi);
      v[0] = speed * (angle - std::sin(angle)) / (2 * std::numbers::pi), a[0] = speed / end * (1 - std::cos(angle));
    };
    double size = 1;
    for (int i = 0; size > 1e-6; ++i) {
      REQUIRE(i < 20);
      step_by();
      const auto& d = inverse_dynamics_derivatives(c, s, q, v, a);
      const Eigen::MatrixXd k = d.by_a + dt / 2 * d.by_v + dt * dt / 4 * d.by_q;
      const Eigen::VectorXd change = k(free, free).lu().solve(d.tau(free));
      a(free) -= change, size = change.norm();
    }
    step_by();
    most = std::min(most, q[3 * n - 1]);
  }
  CHECK(most == within(-0.573787, 2e-4));
}

TEST_CASE("a beam that swings and bends keeps its energy", "[long]") {
  runtime_chain c;
  const beam_section section{.EA = 200, .EI_y = 0.5, .EI_z = 1, .GJ = 0.4, .GA_y = 100, .GA_z = 80};
  const auto J = diagonal(0.02, 0.005, 0.005);
  c << spherical_joint_3D("ball", "ground", "0") << free_joint_3D("at 1", "ground", "1")
    << free_joint_3D("at 2", "ground", "2") << flexible_beam_3D("0", "1", 0.5, section, vec3{0.1, 0.2, -0.3})
    << flexible_beam_3D("1", "2", 0.5, section) << inertial_beam_3D("0", "1", 0.6, J)
    << inertial_beam_3D("1", "2", 0.6, J);
  c.gravity(along_z(-9.81));
  manipulator_dynamics_model model(c);
  Eigen::VectorXd q = neutral_configuration(c), v = Eigen::VectorXd::Zero(c.dofs());
  q[4] = 0.5, q[11] = 1, v[1] = 1, v[2] = 0.5, v[9] = 0.7;
  dormand_prince45 solver(std::ref(model), 0.0, model.make_x(q, v), {.absolute = 1e-10, .relative = 1e-10});
  auto s = c.make_state();
  const auto before = energy(c, s, q, v);
  solver.integrate(1);
  const auto& x = solver.state();
  const auto after = energy(c, s, x.head(c.nq()), x.tail(c.dofs()));
  CHECK(after.potential - before.potential == within(before.kinetic - after.kinetic, 1e-7));
  CHECK(std::abs(after.potential - before.potential) > 0.1);
}

}  // namespace inertial_beam_test
