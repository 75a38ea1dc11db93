#pragma once

#include <kte/dynamics/closed_loops/assemble.hpp>
#include <kte/dynamics/closed_loops/hybrid.hpp>
#include <kte/robots/detail/mass_condition.hpp>
#include <kte/robots/detail/read_values.hpp>
#include <kte/robots/detail/robot_tree.hpp>
#include <kte/robots/robot.hpp>
#include <kte/runtime_chain.hpp>

#include <random>

namespace kte::detail {

inline void find_condition(const robot& r, std::vector<robot_note>& found) {
  const int n = r.chain.dofs();
  if (n == 0) return found.push_back({0, "the robot has no degrees of freedom"});
  const auto c = worst_condition(r.chain);
  if (!c.known)
    found.push_back({0, "the condition of the mass matrix is not computed: of " + std::to_string(n) +
                            " degrees of freedom, where joints share coordinates, it takes too long"});
  if (c.number > 1e8)
    found.push_back({0, "the mass matrix is nearly singular: its condition is " +
                            (c.estimated ? "about " + short_number(c.number) + " (estimated)" : number(c.number)) +
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

/// Whether joints move any mass, by joint.
inline std::vector<char> moving_masses(const robot_description& d, const robot_tree& tree) {
  std::vector<char> heavy(d.links.size()), all(d.joints.size());  // heavy: it, or what it carries, has a mass
  for (std::size_t i = 0; i < d.links.size(); ++i) heavy[i] = d.links[i].inertial && d.links[i].inertial->mass > 0;
  for (auto s = tree.steps().rbegin(); s != tree.steps().rend(); ++s) {
    const auto to = tree.end(*s), from = tree.base(*s);
    all[s->joint] = heavy[to], heavy[from] |= heavy[to];
  }
  return all;
}

inline void find_in_joints(const robot_description& d, const robot_tree& tree, std::vector<robot_note>& found) {
  const auto moves_mass = moving_masses(d, tree);
  for (std::size_t i = 0; i < d.joints.size(); ++i) {
    const auto& j = d.joints[i];
    if (j.is == robot_joint::kind::fixed) continue;
    const auto say = [&](const std::string& what) { found.push_back({j.line, "joint '" + j.name + "': " + what}); };
    if (!moves_mass[i]) say("it moves no mass, so that the mass matrix is singular");
    if (j.lower > j.upper) say("lower " + number(j.lower) + " is above upper " + number(j.upper));
    if (j.lower == j.upper) say("lower and upper are both " + number(j.lower) + ": it cannot move");
    if (j.effort == 0) say("its effort is limited to 0");
    if (j.rate == 0) say("its velocity is limited to 0");
    if (j.soft_lower < j.lower || j.soft_upper > j.upper) say("its soft limits are wider than its limits");
  }
}
}  // namespace kte::detail
