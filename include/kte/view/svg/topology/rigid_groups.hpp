#pragma once

#include <kte/view/svg/scene_parts.hpp>

#include <map>
#include <set>

namespace kte::detail::svg {

/// Groups of frames that move together, and their connections: the graph of a scene.
class rigid_groups {
 public:
  static constexpr int none = -1;
  struct group {
    std::string name;
    std::vector<std::string> frames{}, loads{};  ///< names of frames, and of loads on this group alone
    double mass = 0;
    int parent = none;
    int joint = none;                 ///< from the parent
    std::vector<std::string> acts{};  ///< names of elements on coordinates of the joint
  };
  /// A connection between two groups that is not in the tree.
  struct tie {
    int from, to;
    std::vector<std::string> names;
    bool joint;  ///< otherwise a force
  };

  explicit rigid_groups(const scene& s) : scene_(s) {
    check_parts(s);
    groups.push_back({"ground"});
    for (std::size_t i = 0; i < s.frames.size(); ++i) put_frame(i);
    for (const auto& b : s.bodies) {
      auto& g = groups[at(of(b.frame))];
      if (g.mass == 0 && !b.name.empty() && &g != &groups[0]) g.name = b.name;
      g.mass += b.mass;
    }
    for (std::size_t j = 0; j < s.joints.size(); ++j) put_joint(static_cast<int>(j));
    for (const auto& l : s.links) put_between(of(l.from), of(l.to), l.type);
    for (const auto& f : s.forces) put_force(f);
  }

  std::vector<group> groups;  ///< the first is the ground
  std::vector<tie> ties;
  int of(int frame) const { return frame < 0 ? 0 : group_of_[at(frame)]; }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static void add_once(std::vector<std::string>& all, const std::string& x) {
    if (std::find(all.begin(), all.end(), x) == all.end()) all.push_back(x);
  }
  void put_frame(std::size_t i) {
    const auto& f = scene_.frames[i];
    if (f.track >= 0) {
      group_of_.push_back(static_cast<int>(groups.size()));
      groups.push_back({f.name});
    } else {
      group_of_.push_back(of(f.parent));
    }
    groups[at(group_of_.back())].frames.push_back(f.name);
  }
  bool is_above(int one, int other) const {
    for (int g = other; g != none; g = groups[at(g)].parent)
      if (g == one) return true;
    return false;
  }
  void put_joint(int joint) {
    const auto& j = scene_.joints[at(joint)];
    const int a = of(j.before), b = of(j.after);
    auto& g = groups[at(b)];
    if (b != 0 && g.parent == none && !is_above(b, a)) {
      g.parent = a, g.joint = joint;
      for (const int c : j.coordinates) joint_of_.emplace(c, b);
    } else if (a != b) {
      tie_of(a, b, j.name.empty() ? j.type : j.name, true);
    }
  }
  void put_between(int a, int b, const std::string& name) {
    if (a != b && !(groups[at(b)].parent == a || groups[at(a)].parent == b)) tie_of(a, b, name, false);
  }
  void put_force(const scene::force& f) {
    std::set<int> on;
    for (const int i : f.frames) on.insert(of(i));
    if (on.size() >= 2) {
      tie_of(*on.begin(), *on.rbegin(), f.type, false);
    } else if (on.size() == 1) {
      add_once(groups[at(*on.begin())].loads, f.type);
    } else {
      for (const int c : f.coordinates)
        if (const auto j = joint_of_.find(c); j != joint_of_.end()) on.insert(j->second);
      if (on.size() >= 2)
        tie_of(*on.begin(), *on.rbegin(), f.type, false);
      else if (on.size() == 1)
        add_once(groups[at(*on.begin())].acts, f.type);
    }
  }
  void tie_of(int a, int b, const std::string& name, bool joint) {
    const auto [from, to] = std::minmax(a, b);
    for (auto& t : ties)
      if (t.from == from && t.to == to && t.joint == joint) return add_once(t.names, name);
    ties.push_back({from, to, {name}, joint});
  }

  const scene& scene_;
  std::vector<int> group_of_;
  std::map<int, int> joint_of_;  ///< the group moved by the joint of a coordinate
};

}  // namespace kte::detail::svg
