#pragma once

#include <kte/view/svg/path_data.hpp>
#include <kte/view/svg/text_width.hpp>
#include <kte/view/svg/topology/rigid_groups.hpp>
#include <kte/view/svg/topology/tidy_tree.hpp>

namespace kte::detail::svg {

/// "a, b, c"
inline std::string joined(const std::vector<std::string>& all) {
  std::string s;
  for (const auto& x : all) s.append(s.empty() ? "" : ", ").append(x);
  return s;
}

/// Positions of the boxes and arcs of a topology, mm, for a font size.
class topology_layout {
 public:
  topology_layout(const scene& s, const rigid_groups& g, double font) : scene_(s), g_(g), font_(font) {
    lay_out();
    for (const auto& t : g_.ties) beside_ = beside_ || tree_[node_of(t.from)].layer == tree_[node_of(t.to)].layer;
    double least = 0;
    for (const auto& n : tree_) {
      most_ = (std::max)(most_, n.x + n.right), layers_ = (std::max)(layers_, static_cast<double>(n.layer));
    }
    for (std::size_t i = 0; i < g_.ties.size(); ++i) {
      const auto c = arc(i);
      const double bow = 0.75 * (std::min)(c[1].x, c[2].x) + 0.25 * (std::min)(c[0].x, c[3].x);
      least = (std::min)(least, bow - label_width(i));
    }
    left_ = 2 - least;
  }

  double width() const { return left_ + most_ + 2; }
  double height() const { return 4 + layers_ * layer() + box() + (beside_ ? 2 * font_ : 0); }
  std::size_t size() const { return order_.size(); }
  const rigid_groups::group& group(std::size_t node) const { return g_.groups[at(order_[node])]; }
  const tidy_tree::node& node(std::size_t i) const { return tree_[i]; }
  std::size_t node_of(int group) const { return node_of_[at(group)]; }
  double box() const { return 1.7 * font_; }
  double layer() const { return (beside_ ? 6 : 4.4) * font_; }
  double radius() const { return 0.75 * font_; }
  std::string name_of(const rigid_groups::group& g) const { return shortened(g.name, 14); }
  std::string joint_name(const rigid_groups::group& g) const {
    const auto& j = scene_.joints[at(g.joint)];
    return shortened(j.name.empty() ? j.type : j.name, 14);
  }
  std::string acts_of(const rigid_groups::group& g) const { return shortened(joined(g.acts), 16); }

  picture_point place(std::size_t node) const {
    return {left_ + tree_[node].x, 2 + box() / 2 + static_cast<double>(tree_[node].layer) * layer()};
  }
  double half_width(std::size_t node) const { return tree_[node].left; }
  /// An arc from box to box, around the left of the boxes between them.
  std::array<picture_point, 4> arc(std::size_t tie) const {
    const auto a = node_of_[at(g_.ties[tie].from)], b = node_of_[at(g_.ties[tie].to)];
    const auto p = place(a), q = place(b);
    const double apart = std::abs(p.y - q.y), bow = (std::max)(2 * font_ + 0.3 * apart, 1.4 * label_width(tie));
    if (apart < 1) {  // boxes in one layer: below
      const double down = box() / 2 + 1.6 * font_;
      return {{{p.x, p.y + box() / 2}, {p.x, p.y + down}, {q.x, q.y + down}, {q.x, q.y + box() / 2}}};
    }
    const double from = p.x - half_width(a), to = q.x - half_width(b), out = (std::min)(from, to) - bow;
    return {{{from, p.y}, {out, p.y}, {out, q.y}, {to, q.y}}};
  }
  std::string tie_name(std::size_t i) const { return shortened(joined(g_.ties[i].names), 16); }
  double label_width(std::size_t i) const { return 0.4 * text_width(tie_name(i)) * font_; }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  /// Groups as nodes, parents first.
  void lay_out() {
    std::vector<std::vector<int>> children(g_.groups.size());
    std::vector<int> order;
    for (std::size_t i = 0; i < g_.groups.size(); ++i) {
      const auto& g = g_.groups[i];
      if (g.parent >= 0)
        children[at(g.parent)].push_back(static_cast<int>(i));
      else if (i != 0 || stands())
        order.push_back(static_cast<int>(i));
    }
    const std::size_t roots = order.size();
    for (std::size_t i = 0; i < order.size(); ++i)
      order.insert(order.end(), children[at(order[i])].begin(), children[at(order[i])].end());
    node_of_.assign(g_.groups.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i) node_of_[at(order[i])] = i;
    std::vector<tidy_tree::node> nodes(order.size());
    std::vector<std::size_t> root_nodes;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto& g = g_.groups[at(order[i])];
      const double half = (text_width(name_of(g)) / 2 + 0.6) * font_;
      nodes[i].left = half, nodes[i].right = half;
      if (g.joint >= 0)
        nodes[i].right = (std::max)(
            half, radius() + 0.4 * font_ + (std::max)(text_width(joint_name(g)), 0.8 * text_width(acts_of(g))) * font_);
      for (const int c : children[at(order[i])]) nodes[i].children.push_back(node_of_[at(c)]);
      if (i < roots) root_nodes.push_back(i);
    }
    order_ = std::move(order);
    tree_ = tidy_tree(std::move(nodes), root_nodes, 1.2 * font_).nodes();
  }
  /// Whether anything is connected to the ground.
  bool stands() const {
    for (const auto& g : g_.groups)
      if (g.parent == 0) return true;
    for (const auto& t : g_.ties)
      if (t.from == 0) return true;
    return g_.groups.size() == 1;
  }

  const scene& scene_;
  const rigid_groups& g_;
  double font_, left_ = 0, most_ = 0, layers_ = 0;
  std::vector<int> order_;            ///< groups by nodes
  std::vector<std::size_t> node_of_;  ///< nodes by groups
  std::vector<tidy_tree::node> tree_;
  bool beside_ = false;  ///< whether arcs connect boxes of one layer
};

}  // namespace kte::detail::svg
