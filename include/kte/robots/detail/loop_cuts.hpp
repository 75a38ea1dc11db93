#pragma once

#include <kte/robots/detail/angles.hpp>
#include <kte/robots/detail/link_numbers.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace kte::detail {

/// Cuts the loops of links and joints of a description: joints that close one become closures of their kind. Joints are
/// taken in the order of the file; those that others follow, with forces, limits of effort or without a closure of
/// their kind (screws) come first, so that they stay joints if a loop has others.
class loop_cuts {
 public:
  explicit loop_cuts(robot_description& d) : d_(d) {
    for (std::size_t i = 0; i < d.joints.size(); ++i)
      if (d.joints[i].mimic) followers_.emplace(d.joints[i].mimic->joint, i);
  }

  void cut() {
    find_crosses();
    const link_numbers links(d_);
    const auto ends = links.of(d_.joints);
    joined_sets parts(links.count());
    std::set<std::size_t> closing;
    for (const int rank : {0, 1, 2})
      for (std::size_t i = 0; i < d_.joints.size(); ++i) {
        if (second_.contains(i) || rank_of(i) != rank) continue;
        if (!parts.join(ends[i].parent, ends[last_number(i)].child)) closing.insert(i);
      }
    if (closing.empty()) return;
    std::set<std::size_t> gone;
    std::set<std::string> links_gone;
    for (const auto i : closing) {
      d_.closures.push_back(closure(i));
      gone.insert(i);
      if (const auto c = crosses_.find(i); c != crosses_.end()) {
        gone.insert(c->second);
        links_gone.insert(d_.joints[i].child);
      }
    }
    std::erase_if(d_.links, [&](const robot_link& l) { return links_gone.contains(l.name); });
    std::vector<robot_joint> left;
    for (std::size_t i = 0; i < d_.joints.size(); ++i)
      if (!gone.contains(i)) left.push_back(std::move(d_.joints[i]));
    d_.joints = std::move(left);
  }

 private:
  using kind = robot_joint::kind;

  /// Universal joints, which are two about axes that meet at a right angle, with a link without a body in between.
  void find_crosses() {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i + 1 < d_.joints.size(); ++i) {
      const auto &a = d_.joints[i], &b = d_.joints[i + 1];
      if (a.is != kind::revolute || b.is != kind::revolute || a.child != b.parent || b.name != a.name + "_2" ||
          !is_nothing(a.child_pose) || !is_nothing(b.origin) || std::abs(dot(a.axis, b.axis)) > 1e-12)
        continue;
      found.push_back(i);
    }
    if (found.empty()) return;
    std::unordered_map<std::string_view, int> joints_at;
    for (const auto& j : d_.joints) ++joints_at[j.parent], joints_at[j.child] += j.parent != j.child;
    for (const auto i : found)
      if (joints_at[d_.joints[i].child] == 2) crosses_.emplace(i, i + 1), second_.insert(i + 1);
  }
  std::size_t last_number(std::size_t i) const {
    const auto c = crosses_.find(i);
    return c == crosses_.end() ? i : c->second;
  }
  const robot_joint& last_of(std::size_t i) const { return d_.joints[last_number(i)]; }
  int rank_of(std::size_t i) const {
    const auto rank = [&](const robot_joint& j) {
      if (j.is == kind::screw || j.is == kind::planar || j.is == kind::floating || j.mimic ||
          followers_.contains(j.name))
        return 0;
      return j.dynamics != robot_joint_dynamics{} || j.effort != robot_joint::none ? 1 : 2;
    };
    return (std::min)(rank(d_.joints[i]), rank(last_of(i)));
  }

  robot_closure closure(std::size_t i) {
    const auto &j = d_.joints[i], &last = last_of(i);
    robot_closure c;
    c.name = j.name, c.line = j.line, c.file = j.file;
    c.link1 = j.parent, c.link2 = last.child;
    c.origin1 = j.origin, c.origin2 = inverse_of(last.child_pose), c.axis = j.axis;
    if (&j != &last)
      c.is = robot_closure::kind::universal, c.axis2 = last.axis;
    else if (j.is == kind::revolute)
      c.is = robot_closure::kind::hinge;
    else if (j.is == kind::prismatic)
      c.is = robot_closure::kind::sliding;
    else if (j.is == kind::spherical)
      c.is = robot_closure::kind::points;
    else if (j.is == kind::fixed)
      c.is = robot_closure::kind::frames;
    else
      fail(j, "it closes a loop, which a joint of its type cannot");
    for (const auto* k : {&j, &last}) {
      if (k->mimic) fail(*k, "it closes a loop, and cannot follow another joint");
      if (const auto f = followers_.find(k->name); f != followers_.end())
        fail(d_.joints[f->second], "it follows '" + k->name + "', which closes a loop");
      if (k->dynamics != robot_joint_dynamics{})
        d_.warnings.push_back({k->line,
                               "joint '" + k->name + "': it closes a loop: its damping, friction, spring and " +
                                   "rotor inertia are left out",
                               k->file, true});
      if (k->lower != -robot_joint::none || k->upper != robot_joint::none)
        d_.not_read.push_back({k->line, "joint '" + k->name + "': it closes a loop: its limits are left out", k->file});
      if (&j == &last) break;
    }
    return c;
  }
  [[noreturn]] void fail(const robot_joint& j, const std::string& why) const {
    raise<bad_file>("kte: " + place_text(j.file.empty() ? d_.source : j.file, j.line) + "joint '" + j.name +
                    "': " + why);
  }

  robot_description& d_;
  std::map<std::size_t, std::size_t> crosses_;  ///< the second joint of a universal one, by the first
  std::set<std::size_t> second_;
  std::unordered_map<std::string, std::size_t> followers_;  ///< the first joint that follows one, by its name
};

}  // namespace kte::detail
