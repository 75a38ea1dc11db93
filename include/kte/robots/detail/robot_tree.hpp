#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/errors.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/detail/angles.hpp>

#include <functional>
#include <queue>
#include <string_view>
#include <unordered_map>

namespace kte::detail {

/// The tree that links and joints make, with closures between them: checked, and in the order in which a chain takes
/// it.
class robot_tree {
 public:
  struct step {
    std::size_t joint;
    bool reversed;  ///< traversed from child to parent, because of the chosen root
  };

  /// Throws `bad_file` if links and joints form no tree, `bad_argument` if the chosen root is no link.
  robot_tree(const robot_description& d, const std::string& chosen_root);

  std::size_t root() const { return root_; }
  /// Every joint once, after the joint that moves its base; in the order of the file where possible.
  const std::vector<step>& steps() const { return steps_; }
  /// The link on which a joint stands in this order, and the link that it moves.
  std::size_t base(const step& s) const { return s.reversed ? ends_[s.joint].child : ends_[s.joint].parent; }
  std::size_t end(const step& s) const { return s.reversed ? ends_[s.joint].parent : ends_[s.joint].child; }
  std::size_t parent(std::size_t joint) const { return ends_[joint].parent; }
  std::size_t child(std::size_t joint) const { return ends_[joint].child; }
  std::size_t link(const std::string& name) const { return links_.at(name); }
  bool has_link(const std::string& name) const { return links_.contains(name); }
  std::size_t joint(const std::string& name) const { return joints_.at(name); }

 private:
  static constexpr std::size_t nowhere = ~std::size_t{0};
  using index = std::unordered_map<std::string_view, std::size_t>;

  [[noreturn]] void fail(int line, const std::string& why) const {
    raise<bad_file>("kte: " + place_text(d_.source, line) + why);
  }
  void name_all();
  void find_root();
  void check_mimics() const;
  void check_closures() const;
  void order(const std::string& chosen_root);

  const robot_description& d_;
  struct ends {
    std::size_t parent, child;
  };
  index links_, joints_;
  std::vector<ends> ends_;                 ///< by joint
  std::vector<std::size_t> parent_joint_;  ///< by link
  std::size_t root_ = nowhere;
  std::vector<step> steps_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION robot_tree::robot_tree(const robot_description& d, const std::string& chosen_root) : d_(d) {
  name_all();
  find_root();
  check_mimics();
  check_closures();
  order(chosen_root);
}

KTE_FUNCTION void robot_tree::name_all() {
  links_.reserve(d_.links.size()), joints_.reserve(d_.joints.size()), ends_.reserve(d_.joints.size());
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    const auto& l = d_.links[i];
    if (l.name.empty()) fail(l.line, "a link has no name");
    const auto [first, fresh] = links_.emplace(l.name, i);
    if (!fresh)
      fail(l.line, "link '" + l.name + "' is already defined in line " + std::to_string(d_.links[first->second].line));
  }
  if (d_.links.empty()) fail(0, "the robot has no links");
  parent_joint_.assign(d_.links.size(), nowhere);
  for (std::size_t i = 0; i < d_.joints.size(); ++i) {
    const auto& j = d_.joints[i];
    const auto refuse = [&](const std::string& why) { fail(j.line, "joint '" + j.name + "': " + why); };
    if (j.name.empty()) fail(j.line, "a joint has no name");
    const auto [first, fresh] = joints_.emplace(j.name, i);
    if (!fresh) refuse("it is already defined in line " + std::to_string(d_.joints[first->second].line));
    const auto end = [&](const char* which, const std::string& name) {
      const auto at = links_.find(name);
      if (at == links_.end()) refuse(std::string("its ") + which + " '" + name + "' is not a link");
      return at->second;
    };
    const auto& own = ends_.emplace_back(ends{end("parent", j.parent), end("child", j.child)});
    if (own.parent == own.child) refuse("its parent and its child are the same link '" + j.child + "'");
    auto& above = parent_joint_[own.child];
    if (above != nowhere)
      refuse("its child '" + j.child + "' is already the child of joint '" + d_.joints[above].name + "' (line " +
             std::to_string(d_.joints[above].line) + "): a link has one parent, and closures close loops");
    above = i;
  }
}

KTE_FUNCTION void robot_tree::find_root() {
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    if (parent_joint_[i] != nowhere) continue;
    if (root_ != nowhere)
      fail(d_.links[i].line, "link '" + d_.links[i].name + "' is a root beside link '" + d_.links[root_].name +
                                 "' (line " + std::to_string(d_.links[root_].line) + "): no joint has it as child");
    root_ = i;
  }
  // each link has at most one joint above it: a link that the root does not carry is on a cycle or carried by one
  std::vector<char> known(d_.links.size(), 0);
  if (root_ != nowhere) known[root_] = 1;
  for (std::size_t i = 0; i < d_.links.size(); ++i) {
    std::vector<std::size_t> way;
    for (std::size_t l = i; known[l] != 1; l = parent(parent_joint_[l])) {
      if (known[l] == 2) {
        const auto& j = d_.joints[parent_joint_[l]];
        fail(j.line, "joint '" + j.name + "' is part of a cycle: its child '" + j.child + "' carries its parent '" +
                         j.parent + "'");
      }
      known[l] = 2, way.push_back(l);
    }
    for (const auto l : way) known[l] = 1;
  }
}

KTE_FUNCTION void robot_tree::check_mimics() const {
  const auto refuse = [this](const robot_joint& j, const std::string& why) {
    fail(j.line, "joint '" + j.name + "': " + why);
  };
  std::vector<std::size_t> masters(d_.joints.size(), nowhere);
  for (std::size_t i = 0; i < d_.joints.size(); ++i) {
    const auto& j = d_.joints[i];
    if (!j.mimic) continue;
    const auto it = joints_.find(j.mimic->joint);
    if (it == joints_.end()) refuse(j, "it mimics joint '" + j.mimic->joint + "', which does not exist");
    const auto& master = d_.joints[it->second];
    if (!has_one_coordinate(master)) refuse(j, "it mimics joint '" + master.name + "', which has no single coordinate");
    masters[i] = it->second;
  }
  std::vector<std::size_t> seen(d_.joints.size(), nowhere);  // by joint: the joint through which it was reached
  for (std::size_t i = 0; i < d_.joints.size(); ++i)
    for (std::size_t k = i; k != nowhere; k = masters[k]) {
      if (seen[k] == i) refuse(d_.joints[i], "it mimics joints that mimic each other");
      if (seen[k] != nowhere) break;
      seen[k] = i;
    }
}

KTE_FUNCTION void robot_tree::check_closures() const {
  std::unordered_map<std::string_view, int> names;
  for (const auto& c : d_.closures) {
    const auto refuse = [&](const std::string& why) { fail(c.line, "closure '" + c.name + "': " + why); };
    if (c.name.empty()) fail(c.line, "a closure has no name");
    if (const auto [first, fresh] = names.emplace(c.name, c.line); !fresh)
      refuse("it comes a second time, after line " + std::to_string(first->second));
    const bool of_joints = c.is == robot_closure::kind::joints;
    for (const auto* end : {&c.link1, &c.link2}) {
      if (!of_joints && !links_.contains(*end)) refuse("'" + *end + "' is not a link");
      if (!of_joints) continue;
      const auto it = joints_.find(*end);
      if (it == joints_.end()) refuse("'" + *end + "' is not a joint");
      if (!has_one_coordinate(d_.joints[it->second])) refuse("joint '" + *end + "' has no single coordinate");
    }
    if (c.link1 == c.link2)
      refuse("both its ends are the same " + std::string(of_joints ? "joint" : "link") + " '" + c.link1 + "'");
  }
}

KTE_FUNCTION void robot_tree::order(const std::string& chosen_root) {
  if (!chosen_root.empty()) {
    const auto it = links_.find(chosen_root);
    if (it == links_.end())
      raise<bad_argument>("kte: the robot '" + d_.name + "' has no link '" + chosen_root + "' to be its root");
    root_ = it->second;
  }
  std::vector<std::vector<std::size_t>> at(d_.links.size());  // by link: its joints in either direction
  for (std::size_t i = 0; i < ends_.size(); ++i) at[ends_[i].parent].push_back(i), at[ends_[i].child].push_back(i);
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
  std::vector<char> placed(d_.links.size(), 0);
  std::vector<char> taken(d_.joints.size(), 0);
  const auto place = [&](std::size_t l) {
    placed[l] = 1;
    for (const auto j : at[l])
      if (!taken[j]) taken[j] = 1, ready.push(j);
  };
  place(root_);
  while (!ready.empty()) {
    const std::size_t j = ready.top();
    ready.pop();
    steps_.push_back({j, placed[child(j)] != 0});
    place(end(steps_.back()));
  }
}
#endif

}  // namespace kte::detail
