#pragma once

#include <kte/robots/detail/loop_cuts.hpp>
#include <kte/robots/detail/sdf_frames.hpp>

#include <functional>
#include <numeric>
#include <set>

namespace kte::detail {

/// Makes one tree of the links and joints of a model: what stands still is fixed, joints that close loops become
/// closures, joints are turned round where the tree needs it, and parts that no joint connects move freely.
class sdf_tree {
 public:
  using placer = std::function<robot_pose(const std::string&, const std::string&)>;

  /// `place(a, b)` returns the pose of b in a.
  sdf_tree(robot_description& d, placer place) : d_(d), place_(std::move(place)) {
    for (const auto& j : d.joints) joints_.insert(j.name);
  }

  /// Fixes static links, to the world if that is a link.
  void fix(const std::set<std::string>& still) {
    if (still.empty()) return;
    const bool world = std::any_of(d_.links.begin(), d_.links.end(), [](const auto& l) { return l.name == "world"; });
    const auto in = [&](const std::string& link) { return still.contains(link) || (world && link == "world"); };
    std::erase_if(d_.joints, [&](const robot_joint& j) { return in(j.parent) && in(j.child); });
    std::string anchor = world ? "world" : "";
    for (const auto& l : d_.links) {
      if (!still.contains(l.name)) continue;
      if (anchor.empty())
        anchor = l.name;
      else
        d_.joints.push_back(between(kind::fixed, anchor, l, ".static"));
    }
  }

  /// Joins the parts and sets the root. `first` is the link whose part is the base if no link is the world.
  std::string join(const std::string& first) {
    loop_cuts(d_).cut();
    std::vector<part> parts = find_parts();
    for (auto& p : parts) direct(p, first);
    const auto holds = [](const part& p, const std::string& link) {
      return std::find(p.links.begin(), p.links.end(), link) != p.links.end();
    };
    auto base = std::find_if(parts.begin(), parts.end(), [&](const part& p) { return holds(p, "world"); });
    if (base == parts.end())
      base = std::find_if(parts.begin(), parts.end(), [&](const part& p) { return holds(p, first); });
    if (base == parts.end()) return {};
    std::map<std::string_view, const robot_link*> links;
    for (const auto& l : d_.links) links.emplace(l.name, &l);
    for (const auto& p : parts) {
      if (&p == &*base) continue;
      const auto& l = *links.at(p.root);
      d_.joints.push_back(between(kind::floating, base->root, l, ".free"));
      d_.warnings.push_back({l.line,
                             "link '" + l.name + "': no joint connects it with '" + base->root +
                                 "': it moves freely, by a floating joint '" + d_.joints.back().name + "'",
                             l.file});
    }
    return base->root;
  }

 private:
  using kind = robot_joint::kind;
  struct part {
    std::vector<std::string> links;
    std::vector<std::size_t> joints;
    std::string root{};
  };

  robot_joint between(kind is, const std::string& parent, const robot_link& child, const char* ending) {
    robot_joint j;
    j.name = child.name + ending, j.line = child.line, j.file = child.file, j.is = is;
    while (!joints_.insert(j.name).second) j.name += '\'';
    j.parent = parent, j.child = child.name, j.origin = place_(parent, child.name);
    return j;
  }

  /// The sets of links that joints connect.
  std::vector<part> find_parts() const {
    std::map<std::string, std::size_t, std::less<>> index;
    for (const auto& l : d_.links) index.emplace(l.name, index.size());
    std::vector<std::size_t> up(index.size());
    std::iota(up.begin(), up.end(), std::size_t{0});
    const auto top = [&](const std::string& link) {
      auto i = index.at(link);
      while (up[i] != i) i = up[i] = up[up[i]];
      return i;
    };
    for (const auto& j : d_.joints) up[top(j.parent)] = top(j.child);
    std::map<std::size_t, std::size_t> which;
    std::vector<part> all;
    for (const auto& l : d_.links) {
      const auto [it, fresh] = which.emplace(top(l.name), all.size());
      if (fresh) all.emplace_back();
      all[it->second].links.push_back(l.name);
    }
    for (std::size_t i = 0; i < d_.joints.size(); ++i) all[which.at(top(d_.joints[i].parent))].joints.push_back(i);
    return all;
  }

  /// Chooses the root of a part: the link without a joint above it, of several the first or that of the base. Joints
  /// that point to it are turned round.
  void direct(part& p, const std::string& first) {
    std::map<std::string, std::vector<std::size_t>> at;
    std::set<std::string> below;
    for (const auto i : p.joints) {
      const auto& j = d_.joints[i];
      at[j.parent].push_back(i), at[j.child].push_back(i), below.insert(j.child);
    }
    for (const auto& l : p.links)
      if (l == "world" || (!below.contains(l) && (p.root.empty() || (l == first && p.root != "world")))) p.root = l;
    std::set<std::size_t> done;
    std::vector<std::string> next{p.root};
    while (!next.empty()) {
      const auto link = next.back();
      next.pop_back();
      for (const auto i : at[link]) {
        if (!done.insert(i).second) continue;
        auto& j = d_.joints[i];
        if (j.child == link) turn(j);
        next.push_back(j.child);
      }
    }
  }
  /// Reverses a joint: X_child = origin J(q) child_pose, so that the pose of the parent in the child is child_pose^-1
  /// J(q)^-1 origin^-1, where J(q)^-1 is J(q) about the opposite axis.
  void turn(robot_joint& j) {
    const auto origin = inverse_of(j.child_pose);
    j.child_pose = inverse_of(j.origin), j.origin = origin, j.axis = {0.0 - j.axis.x, 0.0 - j.axis.y, 0.0 - j.axis.z};
    std::swap(j.parent, j.child);
    d_.warnings.push_back(
        {j.line,
         "joint '" + j.name + "': its child '" + j.parent +
             "' is already moved by another joint: parent and child are exchanged, and its coordinate keeps its sign",
         j.file});
  }

  robot_description& d_;
  placer place_;
  std::set<std::string> joints_;
};

}  // namespace kte::detail
