#pragma once

#include <kte/integrators/prince_dormand87.hpp>
#include <kte/kte.hpp>
#include <kte/loops.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <string>

/// Mechanisms with loops, and their known solutions.
namespace kte::test::loops {

using std::numbers::pi;
using vector = Eigen::VectorXd;

inline vector numbers(std::initializer_list<double> x) {
  vector v(static_cast<Eigen::Index>(x.size()));
  std::copy(x.begin(), x.end(), v.begin());
  return v;
}
/// A uniform bar of 1 kg and 1 m from the origin along x.
inline const auto bar = planar_body(1.0, 1.0 / 12, along_x(0.5));

/// A pendulum of 1 kg and 1 m in Cartesian coordinates (LIM benchmark A01).
inline runtime_chain pendulum() {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << prismatic_joint_2D("x", "base", "a", axis::x)
                            << prismatic_joint_2D("y", "a", "b", axis::y) << inertia_2D("b", point_mass(1.0))
                            << distance_2D("rod", "base", "b", 1.0);
  return c;
}

/// N + 1 bars on pivots (i, 0), and N couplers between their ends (LIM benchmark A02). `twice`: each hinge closed
/// twice. On the parallelogram's branch, with phi from the top,
///
///   phi'' = k sin phi,   k = g ((N + 1) / 2 + N) / ((N + 1) / 3 + N)          (1)
inline runtime_chain four_bars(int n, bool twice = false) {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  for (int i = 0; i <= n; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_2D("q" + s, "base", "b" + s).at(vec2<>{double(i), 0}) << inertia_2D("b" + s, bar)
      << rigid_link_2D("b" + s, "t" + s, along_x(1.0));
  }
  for (int i = 0; i < n; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_2D("c" + s, "t" + s, "k" + s) << inertia_2D("k" + s, bar)
      << rigid_link_2D("k" + s, "e" + s, along_x(1.0))
      << coincident_points_2D("pin" + s, "t" + std::to_string(i + 1), "e" + s);
    if (twice) c << coincident_points_2D("again" + s, "e" + s, "t" + std::to_string(i + 1));
  }
  return c;
}
/// Of that, at the angle phi from the top and its rate.
inline vector four_bar_numbers(int n, double angle) {
  vector x(2 * n + 1);
  x.head(n + 1).setConstant(angle), x.tail(n).setConstant(-angle);
  return x;
}
inline vector four_bar_q(int n, double phi) { return four_bar_numbers(n, pi / 2 - phi); }
inline vector four_bar_v(int n, double rate) { return four_bar_numbers(n, -rate); }
inline double four_bar_constant(int n) { return 9.81 * ((n + 1) / 2.0 + n) / ((n + 1) / 3.0 + n); }

/// Four-bars in space, about z, closed by hinges of five rows; three rows of each are redundant.
inline runtime_chain four_bars_in_space(int n) {
  runtime_chain c;
  c.gravity(along_y(-9.81));
  const rigid_body<> body{1.0, vec3<>{0.5, 0, 0}, sym3<>{1e-3, 0, 0, 1.0 / 12, 0, 1.0 / 12}};
  for (int i = 0; i <= n; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_3D("q" + s, "base", "b" + s, axis::z).at(vec3<>{double(i), 0, 0}) << inertia_3D("b" + s, body)
      << rigid_link_3D("b" + s, "t" + s, along_x(1.0));
  }
  for (int i = 0; i < n; ++i) {
    const auto s = std::to_string(i);
    c << revolute_joint_3D("c" + s, "t" + s, "k" + s, axis::z) << inertia_3D("k" + s, body)
      << rigid_link_3D("k" + s, "e" + s, along_x(1.0))
      << hinge_3D("pin" + s, "t" + std::to_string(i + 1), "e" + s, axis::z);
  }
  return c;
}

/// A crank and a rod of 1 m each; the end of the rod slides along x: q2 = -2 q1, and dead points at q1 = pi/2 + k pi
/// where the end may stay at the pivot.
inline runtime_chain slider_crank_of_equal_bars() {
  runtime_chain c;
  c.gravity(along_y(-9.81)) << revolute_joint_2D("crank", "base", "b") << inertia_2D("b", bar)
                            << rigid_link_2D("b", "t", along_x(1.0)) << revolute_joint_2D("rod", "t", "r")
                            << inertia_2D("r", bar) << rigid_link_2D("r", "end", along_x(1.0))
                            << point_on_line_2D("slot", "base", "end", axis::x);
  return c;
}
/// The angle of its crank at time t, by its one equation of motion: with the middle of the rod at (3/2 cos q, 1/2 sin
/// q),
///
///   T = m(q) q'^2 / 2,  m = 1/3 + 1/12 + 9/4 sin^2 q + 1/4 cos^2 q,   V = g sin q          (2)
inline double slider_crank_angle(double q, double rate, double t) {
  const auto f = [](double, const Eigen::Vector2d& x) {
    const double s = std::sin(x[0]), c = std::cos(x[0]);
    const double m = 1.0 / 3 + 1.0 / 12 + 9.0 / 4 * s * s + c * c / 4;
    return Eigen::Vector2d(x[1], -(9.81 * c + 2 * s * c * x[1] * x[1]) / m);
  };
  prince_dormand87 solver(f, 0.0, Eigen::Vector2d(q, rate), {.absolute = 1e-14, .relative = 1e-14});
  solver.integrate(t);
  return solver.state()[0];
}
/// The angle phi of (1).
inline double four_bar_angle(int n, double phi, double rate, double t) {
  const double k = four_bar_constant(n);
  const auto f = [k](double, const Eigen::Vector2d& x) { return Eigen::Vector2d(x[1], k * std::sin(x[0])); };
  prince_dormand87 solver(f, 0.0, Eigen::Vector2d(phi, rate), {.absolute = 1e-14, .relative = 1e-14});
  solver.integrate(t);
  return solver.state()[0];
}

/// Bennett's linkage: four hinges, with sides a, b and twists alpha, beta in turn, sin(alpha) / a = sin(beta) / b. It
/// has mobility 1, though its closing hinge has 5 rows for 3 coordinates.
inline runtime_chain bennett() {
  const double a = 1, b = 1.4, alpha = 0.6, beta = std::asin(b / a * std::sin(alpha));
  const auto link = [](const std::string& from, const std::string& to, double length, double twist) {
    return rigid_link_3D(from, to, vec3<>{length, 0, 0}, rotation_about(axis::x, twist));
  };
  const rigid_body<> body{1.0, vec3<>{0.4, 0.1, 0.05}, sym3<>{0.02, 0, 0, 0.1, 0, 0.11}};
  runtime_chain c;
  c.gravity(along_z(-9.81)) << revolute_joint_3D("q1", "base", "j1", axis::z) << inertia_3D("j1", body)
                            << link("j1", "e1", a, alpha) << revolute_joint_3D("q2", "e1", "j2", axis::z)
                            << inertia_3D("j2", body) << link("j2", "e2", b, beta)
                            << revolute_joint_3D("q3", "e2", "j3", axis::z) << inertia_3D("j3", body)
                            << link("j3", "e3", a, alpha);
  // the fourth side, from its end at the base back
  const mat3<vec3<>> back = as<double>(matrix(rotation_about(axis::x, -beta)));
  c << rigid_link_3D("base", "f4", back * vec3<>{-b, 0, 0}, back) << hinge_3D("hinge", "f4", "e3", axis::z);
  return c;
}

/// Accelerations by the whole of the equations, J of `loop_jacobian`, in one matrix:
///
///   [ M  -J^T ] [ a      ]   [ tau - bias ]
///   [ J   0   ] [ lambda ] = [ -J_dot v   ]
///
/// with J_dot v by differences of J along q (+) t v.
inline vector by_one_matrix(const runtime_chain& c, runtime_state& s, const vector& q, const vector& v,
                            const vector& tau, const vector& bias) {
  const Eigen::MatrixXd m = mass_matrix(c, s, q), j = loop_jacobian(c, s, q);
  const double h = 1e-4;
  const auto along = [&](double t) -> vector { return loop_jacobian(c, s, integrate(c, q, v, t)) * v; };
  const vector gamma = (8 * (along(h) - along(-h)) - (along(2 * h) - along(-2 * h))) / (12 * h);
  const auto n = m.rows(), r = j.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + r, n + r);
  all.topLeftCorner(n, n) = m, all.topRightCorner(n, r) = -j.transpose(), all.bottomLeftCorner(r, n) = j;
  vector right(n + r);
  right << tau - bias, -gamma;
  return all.fullPivLu().solve(right);
}
/// The largest residual and rate of one that loops have at a state x of a model, m and rad.
template <class Model>
double open_by(const runtime_chain& c, runtime_state& s, const Model& m, const vector& x) {
  const auto r = kte::loops(c, s, vector(m.positions_of(x)));
  const vector rates = loop_jacobian(c, s, vector(m.positions_of(x))) * m.velocities_of(x);
  return (std::max)(r.gap, rates.cwiseAbs().maxCoeff());
}

}  // namespace kte::test::loops
