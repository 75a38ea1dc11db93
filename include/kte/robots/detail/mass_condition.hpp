#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/runtime_chain.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>
#include <random>

namespace kte::detail {

/// The condition number of the mass matrix M of a chain, where rows and columns are divided by the square roots of the
/// diagonal so that units do not matter: of S_ij = M_ij / sqrt(M_ii M_jj). Infinite where a coordinate moves no mass.
struct mass_condition {
  double number = 1;       ///< the largest at the configurations
  int configurations = 0;  ///< random ones, of a fixed seed
  bool estimated = false;  ///< at least this, and seldom more than twice: of more than `exact_up_to` coordinates
  bool known = true;       ///< not of that many coordinates where forward dynamics needs the whole matrix
  static constexpr int exact_up_to = 100;
};

/// The condition at a configuration by all eigenvalues; in long double, as those of singular matrices are rounding
/// errors.
inline double exact_condition(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& q) {
  // Scalars, not packs: with packs of AVX-512, g++ 12 warns of uninitialised registers in its own headers.
  using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const int n = c.dofs();
  const auto& m = mass_matrix(c, s, q);
  matrix scaled(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) scaled(i, j) = m(i, j) / std::sqrt(m(i, i) * m(j, j));
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!scaled.allFinite()) return infinite;
  const Eigen::SelfAdjointEigenSolver<matrix> modes(scaled, Eigen::EigenvaluesOnly);
  const long double low = modes.eigenvalues()[0], high = modes.eigenvalues()[n - 1];
  return low > 0 ? static_cast<double>(high / low) : infinite;
}

/// The chain with the mass matrix of another, in which nothing else exerts forces: its joints, bodies and followers.
inline runtime_chain masses_of(const runtime_chain& c) {
  runtime_chain masses;
  masses.gravity(vec3<>{});
  for (const auto& e : c.wiring().elements) {
    const auto n = e.element->numbers();
    const bool weighs = n.has_mass || n.distributed_mass;
    if (weighs || (n.is != part::force && n.is != part::signal && n.is != part::closure))
      masses.append(e.element->clone());
  }
  return masses;
}
/// The diagonal of M at a configuration; of a coordinate that others follow without products of different ones.
inline Eigen::VectorXd mass_diagonal(const runtime_chain& c, runtime_state& s, const Eigen::VectorXd& q) {
  const runtime_elements all{c};
  take(c, s, q).call([&] { place_bodies(all, s); });
  const auto& t = s.tree();
  tree::carry_bodies<false>(t.body_tree, s.work);
  Eigen::VectorXd d = Eigen::VectorXd::Zero(t.plan.coordinates);
  for (int i = 0; t.has_own_mass && i < t.plan.coordinates; ++i) d[i] = t.own_mass[static_cast<std::size_t>(i)];
  for (std::size_t i = 0; i < t.body_tree.nodes.size(); ++i) {
    const auto& r = t.body_tree.nodes[i];
    const auto& at = s.work.joint_transforms[i];
    const auto& carried = s.work.carried[static_cast<std::size_t>(t.body_tree.bases) + i];
    for (int k = 0; k < r.axes; ++k)
      d[t.body_tree.row[static_cast<std::size_t>(r.first + k)]] += tree::with_axis(r, at, k, [&](const auto& axis) {
        return as<double>(engine::power(axis, tree::accelerating(r, at, k, carried)));
      });
  }
  pull_back_followers(all, s, [&d](int to, int from, double ratio) { d[to] += ratio * ratio * d[from]; });
  return d.head(c.dofs());
}
/// The condition at a configuration by power iteration (Golub and Van Loan, Matrix Computations, 2013, section 8.2) on
/// S by inverse dynamics and on its inverse by forward dynamics, in a time linear in n for each of 2 * 16 steps.
/// `masses`: the result of `masses_of`.
inline double estimated_condition(const runtime_chain& masses, runtime_state& s, const Eigen::VectorXd& q) {
  const Eigen::VectorXd root = mass_diagonal(masses, s, q).cwiseSqrt(), none = Eigen::VectorXd::Zero(masses.dofs());
  if (!(root.minCoeff() > 0)) return std::numeric_limits<double>::infinity();
  const auto largest = [&](const auto& times) {
    std::mt19937 engine(2);
    Eigen::VectorXd x(none.size());
    for (auto& component : x) component = static_cast<double>(engine()) * 0x1p-31 - 1;
    const Eigen::VectorXd at_zero = times(none);
    double size = 0;
    for (int step = 0; step < 16; ++step) {
      x = times(x / x.norm()) - at_zero;
      size = x.norm();
    }
    return size;
  };
  try {
    const double high = largest([&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return inverse_dynamics(masses, s, q, none, x.cwiseQuotient(root)).cwiseQuotient(root);
    });
    const double inverse_low = largest([&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return forward_dynamics(masses, s, q, none, x.cwiseProduct(root)).cwiseProduct(root);
    });
    return high * inverse_low;
  } catch (const singular_mass_matrix&) {
    return std::numeric_limits<double>::infinity();
  }
}

/// The worst condition at twenty random configurations; at fewer, down to two, of more than 5000 coordinates.
inline mass_condition worst_condition(const runtime_chain& c) {
  mass_condition worst;
  const int n = c.dofs();
  worst.estimated = n > mass_condition::exact_up_to;
  worst.configurations = worst.estimated ? std::clamp(100000 / n, 2, 20) : 20;
  const auto masses = worst.estimated ? masses_of(c) : runtime_chain();
  const auto& used = worst.estimated ? masses : c;
  auto s = used.make_state();
  worst.known = !worst.estimated || s.tree().plan.tree || s.tree().clusters.complete;
  std::mt19937 engine(1);
  for (int trial = 0; worst.known && trial < worst.configurations; ++trial) {
    Eigen::VectorXd step(n);
    for (auto& x : step) x = (static_cast<double>(engine()) * 0x1p-31 - 1) * 3;  // rad, m
    const Eigen::VectorXd q = integrate(used, neutral_configuration(used), step, 1.0);
    worst.number =
        (std::max)(worst.number, worst.estimated ? estimated_condition(used, s, q) : exact_condition(used, s, q));
  }
  return worst;
}

}  // namespace kte::detail
