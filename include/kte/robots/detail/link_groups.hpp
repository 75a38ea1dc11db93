#pragma once

#include <kte/robots/detail/robot_tree.hpp>

#include <vector>

namespace kte::detail {

/// The links of a robot in groups; the links of a group are fixed to each other.
class link_groups {
 public:
  link_groups(const robot_description& d, const robot_tree& tree) : group_(d.links.size(), 0), carries_(1, false) {
    for (const auto& s : tree.steps()) {
      const auto& j = d.joints[s.joint];
      const auto parent = group_[tree.base(s)];
      auto& child = group_[tree.end(s)];
      child = parent;
      if (j.is == robot_joint::kind::fixed) continue;
      carries_[parent] = true;
      child = carries_.size(), carries_.push_back(false);
    }
  }
  /// The group of a link; that of the root is 0.
  std::size_t of(std::size_t link) const { return group_[link]; }
  std::size_t count() const { return carries_.size(); }
  /// Whether a joint moves another group in it.
  bool carries(std::size_t group) const { return carries_[group]; }

 private:
  std::vector<std::size_t> group_;
  std::vector<bool> carries_;
};

}  // namespace kte::detail
