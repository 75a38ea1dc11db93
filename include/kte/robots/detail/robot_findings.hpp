#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/loops.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/robot.hpp>
#include <kte/runtime_chain.hpp>

#include <Eigen/Eigenvalues>

#include <random>

namespace kte::detail {

/// The largest condition number of M at random configurations, where rows and columns are divided by the square roots
/// of the diagonal so that units do not matter: M_ij / sqrt(M_ii M_jj). Infinite where a coordinate moves no mass.
inline double worst_condition(const runtime_chain& c) {
  // Scalars, not packs: with packs of AVX-512, g++ 12 warns of uninitialised registers in its own headers.
  using matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  auto s = c.make_state();
  std::mt19937 engine(1);
  double worst = 1;
  const int n = c.dofs();
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd step(n);
    for (int i = 0; i < n; ++i) step[i] = (static_cast<double>(engine()) * 0x1p-31 - 1) * 3;  // rad, m
    const auto& m = mass_matrix(c, s, integrate(c, neutral_configuration(c), step, 1.0));
    matrix scaled(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) scaled(i, j) = m(i, j) / std::sqrt(m(i, i) * m(j, j));
    if (!scaled.allFinite()) return robot_joint::none;
    const Eigen::SelfAdjointEigenSolver<matrix> modes(scaled, Eigen::EigenvaluesOnly);
    const long double low = modes.eigenvalues()[0], high = modes.eigenvalues()[n - 1];
    worst = (std::max)(worst, low > 0 ? static_cast<double>(high / low) : robot_joint::none);
  }
  return worst;
}

inline void find_condition(const robot& r, std::vector<robot_note>& found) {
  if (r.chain.dofs() == 0) return found.push_back({0, "the robot has no degrees of freedom"});
  const double condition = worst_condition(r.chain);
  if (condition > 1e8)
    found.push_back({0, "the mass matrix is nearly singular: its condition is " + number(condition) +
                            " at a random configuration, so that forward dynamics loses as many digits"});
}

/// The configuration from which the loops of a robot are assembled: that of its file, or the neutral one.
inline Eigen::VectorXd start_of_loops(const robot& r) {
  for (const auto& c : r.configurations)
    if (c.name == "reference" && static_cast<int>(c.q.size()) == r.chain.nq())
      return Eigen::Map<const Eigen::VectorXd>(c.q.data(), static_cast<Eigen::Index>(c.q.size()));
  return neutral_configuration(r.chain);
}
/// Rows, rank, mobility and dependent rows of the closures of a robot, at the most regular of eight assemblies near
/// that of its file. Without closures nothing.
inline std::vector<std::string> loop_findings(const robot& r) {
  const auto& c = r.chain;
  if (!has_loops(c)) return {};
  std::vector<std::string> found;
  try {
    auto s = c.make_state();
    const Eigen::VectorXd start = assemble(c, s, start_of_loops(r));
    const auto first = loops(c, s, start);
    auto best = first;
    std::mt19937 engine(1);
    for (int trial = 0; trial < 8; ++trial) {
      Eigen::VectorXd step(c.dofs());
      for (auto& x : step) x = (static_cast<double>(engine()) * 0x1p-31 - 1) * 0.1;  // rad, m
      try {
        const auto other = loops(c, s, assemble(c, s, integrate(c, start, step, 1.0)));
        if (other.rank > best.rank) best = other;
      } catch (const cannot_assemble&) {  // another one will do
      }
    }
    std::string rows;
    for (const auto& name : best.dependent) rows += (rows.empty() ? "" : ", ") + ("'" + name + "'");
    found.push_back("closed loops: " + std::to_string(best.rows) + " rows of closures, rank " +
                    std::to_string(best.rank) + ", mobility " + std::to_string(best.mobility) +
                    (rows.empty() ? "" : "; these rows follow from others: " + rows));
    if (best.mobility == 0) found.push_back("the closures leave no mobility: it cannot move");
    if (first.rank < best.rank)
      found.push_back("where it is assembled from the file it is singular: the rank of its closures is " +
                      std::to_string(first.rank) + " there");
  } catch (const error& e) {
    found.push_back(e.what());
  }
  return found;
}

/// Whether a joint moves any mass.
inline bool moves_mass(const robot_description& d, const robot_tree& tree, std::size_t which) {
  std::vector<char> moved(d.links.size(), 0);
  for (const auto& s : tree.steps()) {
    const auto& j = d.joints[s.joint];
    const auto to = tree.link(s.reversed ? j.parent : j.child), from = tree.link(s.reversed ? j.child : j.parent);
    moved[to] = s.joint == which || moved[from];
    if (moved[to] && d.links[to].inertial && (d.links[to].inertial->mass > 0)) return true;
  }
  return false;
}

inline void find_in_joints(const robot_description& d, const robot_tree& tree, std::vector<robot_note>& found) {
  for (std::size_t i = 0; i < d.joints.size(); ++i) {
    const auto& j = d.joints[i];
    if (j.is == robot_joint::kind::fixed) continue;
    const auto say = [&](const std::string& what) { found.push_back({j.line, "joint '" + j.name + "': " + what}); };
    if (!moves_mass(d, tree, i)) say("it moves no mass, so that the mass matrix is singular");
    if (j.lower > j.upper) say("lower " + number(j.lower) + " is above upper " + number(j.upper));
    if (j.lower == j.upper) say("lower and upper are both " + number(j.lower) + ": it cannot move");
    if (j.effort == 0) say("its effort is limited to 0");
    if (j.rate == 0) say("its velocity is limited to 0");
    if (j.soft_lower < j.lower || j.soft_upper > j.upper) say("its soft limits are wider than its limits");
  }
}
}  // namespace kte::detail
