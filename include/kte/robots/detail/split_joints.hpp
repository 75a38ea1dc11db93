#pragma once

#include <kte/robots/detail/angles.hpp>

#include <set>
#include <utility>

namespace kte::detail {

/// An unused name: `name`, with apostrophes appended while it is taken. Adds it to `taken`.
inline std::string fresh_name(std::set<std::string, std::less<>>& taken, std::string name) {
  while (!taken.insert(name).second) name += '\'';
  return name;
}

/// The robot without child poses: where a child is not at the frame that its joint moves, a link "arm.joint" and a
/// fixed joint are inserted, as in chains.
inline robot_description split_joints(robot_description d) {
  std::set<std::string, std::less<>> taken;
  for (const auto& l : d.links) taken.insert(l.name);
  for (const auto& j : d.joints) taken.insert(j.name);
  std::vector<robot_joint> all;
  all.reserve(d.joints.size());
  for (auto& j : d.joints) {
    const auto rest = std::exchange(j.child_pose, {});
    if (j.is == robot_joint::kind::fixed) {
      j.origin = j.origin * rest;
    } else if (!is_nothing(rest)) {
      robot_joint behind;
      behind.line = j.line, behind.child = j.child, behind.origin = rest;
      behind.name = fresh_name(taken, j.child + "_fixed");
      behind.parent = j.child = fresh_name(taken, j.child + ".joint");
      d.links.emplace_back().name = behind.parent, d.links.back().line = j.line;
      all.push_back(std::move(j)), all.push_back(std::move(behind));
      continue;
    }
    all.push_back(std::move(j));
  }
  d.joints = std::move(all);
  return d;
}

}  // namespace kte::detail
