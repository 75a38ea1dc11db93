#pragma once

#include <kte/robots/detail/loop_cuts.hpp>
#include <kte/robots/detail/sdf_frames.hpp>

#include <functional>
#include <set>
#include <unordered_set>

namespace kte::detail {

/// Makes one tree of the links and joints of a model: what stands still is fixed, joints that close loops become
/// closures, joints are turned round where the tree needs it, and parts that no joint connects move freely.
class sdf_tree {
 public:
  using placer = std::function<robot_pose(const std::string&, const std::string&)>;

  /// `place(a, b)` returns the pose of b in a.
  sdf_tree(robot_description& d, placer place) : d_(d), place_(std::move(place)) {}

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
    std::vector<part> parts = find_parts(first);
    const auto base = std::find_if(parts.begin(), parts.end(), [](const part& p) { return p.is_base; });
    if (base == parts.end()) return {};
    const auto root = d_.links[base->root].name;
    for (const auto& p : parts) {
      if (p.is_base) continue;
      const auto& l = d_.links[p.root];
      d_.joints.push_back(between(kind::floating, root, l, ".free"));
      d_.warnings.push_back({l.line,
                             "link '" + l.name + "': no joint connects it with '" + root +
                                 "': it moves freely, by a floating joint '" + d_.joints.back().name + "'",
                             l.file});
    }
    return root;
  }

 private:
  using kind = robot_joint::kind;
  struct part {
    std::vector<std::size_t> links;
    std::size_t root = 0;
    bool is_base = false;
  };

  robot_joint between(kind is, const std::string& parent, const robot_link& child, const char* ending) {
    robot_joint j;
    j.name = child.name + ending, j.line = child.line, j.file = child.file, j.is = is;
    if (taken_.empty()) {
      for (const auto& other : d_.joints) taken_.insert(other.name);
      for (const auto& c : d_.closures) taken_.insert(c.name);
    }
    while (!taken_.insert(j.name).second) j.name += '\'';
    j.parent = parent, j.child = child.name, j.origin = place_(parent, child.name);
    return j;
  }

  /// The sets of links that joints connect, with their roots; the base holds the world, or else `first`.
  std::vector<part> find_parts(const std::string& first) {
    const link_numbers links(d_);
    const auto ends = links.of(d_.joints);
    joined_sets sets(links.count());
    for (const auto& e : ends) sets.join(e.parent, e.child);
    const std::size_t none = links.count(), world = links.find("world"), usual = links.find(first);
    std::vector<std::size_t> which(links.count(), none);
    std::vector<part> all;
    for (std::size_t l = 0; l < links.count(); ++l) {
      auto& index = which[sets.top(l)];
      if (index == none) index = all.size(), all.emplace_back();
      all[index].links.push_back(l);
    }
    if (const auto base = world != none ? world : usual; base != none) all[which[sets.top(base)]].is_base = true;
    std::vector<std::vector<std::size_t>> at(links.count());  // by link: its joints in either direction
    std::vector<char> below(links.count(), 0);
    for (std::size_t i = 0; i < ends.size(); ++i)
      at[ends[i].parent].push_back(i), at[ends[i].child].push_back(i), below[ends[i].child] = 1;
    std::vector<char> done(ends.size(), 0);
    for (auto& p : all) {
      p.root = none;
      for (const auto l : p.links)
        if (l == world || (!below[l] && (p.root == none || (l == usual && p.root != world)))) p.root = l;
      std::vector<std::size_t> next{p.root};
      while (!next.empty()) {
        const auto link = next.back();
        next.pop_back();
        for (const auto i : at[link]) {
          if (std::exchange(done[i], 1) != 0) continue;
          const bool turned = ends[i].child == link;
          if (turned) turn(d_.joints[i]);
          next.push_back(turned ? ends[i].parent : ends[i].child);
        }
      }
    }
    return all;
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
  std::unordered_set<std::string> taken_;  ///< names of joints, where one needs a name
};

}  // namespace kte::detail
