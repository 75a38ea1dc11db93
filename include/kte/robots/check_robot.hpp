#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/robots/to_robot.hpp>
#include <kte/runtime_chain/check_chain.hpp>

namespace kte {

/// Probable mistakes in a robot, as messages with their line if it is from a file: warnings of reading (inertias that
/// are not physically realizable, angles that are nearly quarter turns, axes that are not of length 1), links that do
/// not form a tree, joints that move no mass, empty ranges, efforts and rates of 0, and a mass matrix that is nearly
/// singular at one of twenty random configurations (fixed seed). Without findings the list is empty. For closed
/// loops also their rows, rank and mobility, redundant rows, and whether they can be assembled.
[[nodiscard]] std::vector<robot_note> check_robot(const robot_description& d, const robot_options& options = {});
/// Probable mistakes in a robot, by its coordinates, with those that `check_chain` finds.
[[nodiscard]] std::vector<robot_note> check_robot(const robot& r);

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/robots/detail/robot_findings.hpp>

namespace kte {
KTE_FUNCTION std::vector<robot_note> check_robot(const robot_description& d, const robot_options& options) {
  auto found = d.warnings;
  try {
    detail::find_in_joints(d, detail::robot_tree(d, options.root), found);
    const auto r = to_robot(d, options);
    for (auto i = d.warnings.size(); i < r.warnings.size(); ++i) found.push_back(r.warnings[i]);
    detail::find_condition(r, found);
    for (const auto& what : detail::loop_findings(r)) found.push_back({0, what});
  } catch (const error& e) {
    found.push_back({0, e.what()});
  }
  return found;
}

KTE_FUNCTION std::vector<robot_note> check_robot(const robot& r) {
  auto found = r.warnings;
  for (const auto& what : check_chain(r.chain)) found.push_back({0, what});
  for (const auto& e : layout(r.chain)) {
    if (e.nv != 1) continue;
    const auto i = static_cast<std::size_t>(e.v);
    const auto say = [&](const std::string& what) { found.push_back({0, "coordinate '" + e.name + "': " + what}); };
    if (r.limits.lower[i] == r.limits.upper[i]) say("it cannot move");
    if (r.limits.effort[i] == 0) say("its effort is limited to 0");
    if (r.limits.rate[i] == 0) say("its velocity is limited to 0");
  }
  try {
    detail::find_condition(r, found);
  } catch (const error& e) {
    found.push_back({0, e.what()});
  }
  for (const auto& what : detail::loop_findings(r)) found.push_back({0, what});
  return found;
}

}  // namespace kte
#endif
