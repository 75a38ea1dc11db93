#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kte::detail::svg {

/// A tree in layers, laid out without overlaps: parents are above the middle of their children, and subtrees are as
/// close to each other as their outlines permit (E. Reingold, J. Tilford, Tidier drawings of trees, 1981).
class tidy_tree {
 public:
  struct node {
    std::vector<std::size_t> children{};
    double left = 0, right = 0;  ///< extent to both sides of its position
    double x = 0;                ///< position; set by the layout
    std::size_t layer = 0;
  };

  /// The nodes of trees with these roots, side by side from 0. Children come after their parents.
  tidy_tree(std::vector<node> nodes, const std::vector<std::size_t>& roots, double gap)
      : nodes_(std::move(nodes)), gap_(gap) {
    std::vector<outline> outlines(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) outlines[i] = laid_out(i, outlines);
    outline all;
    for (const auto r : roots) {
      const double shift = all.right.empty() ? 0 : distance(all, outlines[r]);
      nodes_[r].x = shift, merge(all, outlines[r], shift);
    }
    double least = 0;
    for (const double x : all.left) least = (std::min)(least, x);
    for (const auto r : roots) nodes_[r].x -= least;
    for (const auto& n : nodes_)  // positions were relative to parents so far
      for (const auto c : n.children) nodes_[c].x += n.x, nodes_[c].layer = n.layer + 1;
  }
  const std::vector<node>& nodes() const { return nodes_; }

 private:
  /// The extent of a subtree in each layer, from its root on.
  struct outline {
    std::vector<double> left, right;
  };
  outline laid_out(std::size_t i, const std::vector<outline>& of) {
    auto& n = nodes_[i];
    outline below;
    for (const auto c : n.children) {
      const double shift = below.right.empty() ? 0 : distance(below, of[c]);
      nodes_[c].x = shift, merge(below, of[c], shift);
    }
    const double middle = n.children.empty() ? 0 : (nodes_[n.children.front()].x + nodes_[n.children.back()].x) / 2;
    for (const auto c : n.children) nodes_[c].x -= middle;
    outline all{{-n.left}, {n.right}};
    for (const double x : below.left) all.left.push_back(x - middle);
    for (const double x : below.right) all.right.push_back(x - middle);
    return all;
  }
  double distance(const outline& a, const outline& b) const {
    double d = -1e300;
    for (std::size_t k = 0; k < (std::min)(a.right.size(), b.left.size()); ++k)
      d = (std::max)(d, a.right[k] - b.left[k] + gap_);
    return d;
  }
  static void merge(outline& a, const outline& b, double shift) {
    for (std::size_t k = 0; k < b.left.size(); ++k) {
      if (k == a.left.size()) a.left.push_back(b.left[k] + shift), a.right.push_back(b.right[k] + shift);
      a.left[k] = (std::min)(a.left[k], b.left[k] + shift), a.right[k] = (std::max)(a.right[k], b.right[k] + shift);
    }
  }

  std::vector<node> nodes_;
  double gap_;
};

}  // namespace kte::detail::svg
