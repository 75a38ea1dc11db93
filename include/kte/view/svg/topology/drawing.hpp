#pragma once

#include <kte/view/svg/path_data.hpp>
#include <kte/view/svg/svg_writer.hpp>
#include <kte/view/svg/text_width.hpp>
#include <kte/view/svg/topology/options.hpp>
#include <kte/view/svg/topology/rigid_groups.hpp>
#include <kte/view/svg/topology/tidy_tree.hpp>

namespace kte::detail::svg {

/// The letter of a joint in the theory of mechanisms.
inline const char* joint_letter(std::string_view kind) {
  constexpr std::pair<std::string_view, const char*> letters[]{
      {"revolute", "R"},  {"prismatic", "P"}, {"screw", "H"}, {"cylindrical", "C"}, {"universal", "U"},
      {"spherical", "S"}, {"planar", "E"},    {"free", "F"},  {"fixed", "="}};
  for (const auto& [name, letter] : letters)
    if (name == kind) return letter;
  return "?";
}

/// From the graph of a mechanism to SVG.
class topology_drawing {
 public:
  topology_drawing(const scene& s, const rigid_groups& g, const topology_options& o)
      : scene_(s), g_(g), o_(o), font_(o.font_size * 25.4 / 72) {
    if (!(o.font_size >= 1 && o.font_size <= 100 && o.width >= 0 && o.width <= 5000))
      raise<bad_argument>("kte: a topology has letters of 1 to 100 points and a width of 0 to 5000 mm");
  }

  std::string text() {
    lay_out();
    double least = 0, most = 0, layers = 0;
    for (const auto& n : tree_) {
      most = (std::max)(most, n.x + n.right), layers = (std::max)(layers, static_cast<double>(n.layer));
    }
    for (std::size_t i = 0; i < g_.ties.size(); ++i) {
      const auto c = arc(i);
      least = (std::min)(least, (std::min)(c[1].x, c[2].x) * 0.75 + 0.25 * (std::min)(c[0].x, c[3].x) - label_width(i));
    }
    left_ = 2 - least;
    const double width = left_ + most + 2, height = 4 + layers * layer() + box();
    const double scale = o_.width > 0 ? o_.width / width : 1;
    begin_picture(out_, width * scale, height * scale, o_.font, font_, title(), description());
    out_.begin("g");
    if (scale != 1) out_.set("transform", "scale(" + std::to_string(scale) + ")");
    for (std::size_t i = 0; i < g_.ties.size(); ++i) put_tie(i);
    for (std::size_t i = 0; i < tree_.size(); ++i) put_edge(i);
    for (std::size_t i = 0; i < tree_.size(); ++i) put_box(i);
    for (std::size_t i = 0; i < g_.ties.size(); ++i) put_tie_name(i);
    out_.end().end();
    return out_.document();
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static std::string joined(const std::vector<std::string>& all) {
    std::string s;
    for (const auto& x : all) s.append(s.empty() ? "" : ", ").append(x);
    return s;
  }
  double box() const { return 1.7 * font_; }
  double layer() const { return 4.4 * font_; }
  double radius() const { return 0.75 * font_; }
  std::string name_of(const rigid_groups::group& g) const { return shortened(g.name, 14); }
  std::string joint_name(const rigid_groups::group& g) const {
    const auto& j = scene_.joints[at(g.joint)];
    return shortened(j.name.empty() ? j.type : j.name, 14);
  }
  std::string acts_of(const rigid_groups::group& g) const { return shortened(joined(g.acts), 16); }

  /// Groups as nodes: parents first, as a tree wants them.
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
  /// Whether the ground has anything on it.
  bool stands() const {
    for (const auto& g : g_.groups)
      if (g.parent == 0) return true;
    for (const auto& t : g_.ties)
      if (t.from == 0) return true;
    return g_.groups.size() == 1;
  }

  picture_point place(std::size_t node) const {
    return {left_ + tree_[node].x, 2 + box() / 2 + static_cast<double>(tree_[node].layer) * layer()};
  }
  double half_width(std::size_t node) const { return tree_[node].left; }
  /// From box to box, around the left of what is between them.
  std::array<picture_point, 4> arc(std::size_t tie) const {
    const auto a = node_of_[at(g_.ties[tie].from)], b = node_of_[at(g_.ties[tie].to)];
    const auto p = place(a), q = place(b);
    const double apart = std::abs(p.y - q.y), bow = 2 * font_ + 0.3 * apart;
    if (apart < 1) {  // in one layer: below
      const double down = box() / 2 + 1.6 * font_;
      return {{{p.x, p.y + box() / 2}, {p.x, p.y + down}, {q.x, q.y + down}, {q.x, q.y + box() / 2}}};
    }
    const double from = p.x - half_width(a), to = q.x - half_width(b), out = (std::min)(from, to) - bow;
    return {{{from, p.y}, {out, p.y}, {out, q.y}, {to, q.y}}};
  }
  std::string tie_name(std::size_t i) const { return shortened(joined(g_.ties[i].names), 16); }
  double label_width(std::size_t i) const { return 0.4 * text_width(tie_name(i)) * font_; }

  void put_tie(std::size_t i) {
    const auto c = arc(i);
    path_data d;
    d.move(c[0]), d.curve(c[1], c[2], c[3]);
    out_.begin("path").set("d", d.text()).set("stroke", colour(i)).set("stroke-width", 0.3);
    out_.set("stroke-dasharray", "1.2 0.9").element("title", joined(g_.ties[i].names)).end();
  }
  const char* colour(std::size_t tie) const { return g_.ties[tie].joint ? "#0072b2" : "#b84d00"; }
  /// Where on its arc it is free of other texts, as far as that can be.
  void put_tie_name(std::size_t i) {
    const auto c = arc(i);
    const double half = label_width(i), up = 0.6 * font_;
    picture_point best{};
    std::size_t least = ~std::size_t{0};
    for (int k = 0; k < 14; ++k) {
      const double u = 0.5 + (k % 2 == 0 ? 0.025 : -0.025) * k;
      const double v = 1 - u, a = v * v * v, b = 3 * v * v * u, d = 3 * v * u * u, e = u * u * u;
      const picture_point p{a * c[0].x + b * c[1].x + d * c[2].x + e * c[3].x,
                            a * c[0].y + b * c[1].y + d * c[2].y + e * c[3].y};
      std::size_t covered = 0;
      for (const auto& t : taken_)
        if (p.x - half < t.right && p.x + half > t.left && p.y - up < t.high && p.y + up > t.low) ++covered;
      if (covered < least) least = covered, best = p;
    }
    taken_.push_back({best.x - half, best.x + half, best.y - up, best.y + up});
    put_text({best.x, best.y + 0.3 * font_}, "middle", tie_name(i), 0.8, colour(i));
  }
  /// On white, as lines may be below it.
  void put_text(picture_point p, const char* anchor, const std::string& text, double size, const char* fill) {
    const double w = text_width(text) * size * font_, x = std::string_view(anchor) == "middle" ? p.x - w / 2 : p.x;
    out_.begin("rect")
        .set("x", x)
        .set("y", p.y - 0.85 * size * font_)
        .set("width", w)
        .set("height", 1.1 * size * font_);
    out_.set("fill", "#fff").set("fill-opacity", 0.8).end();
    out_.begin("text").set("x", p.x).set("y", p.y).set("fill", fill);
    if (size != 1) out_.set("font-size", size * font_);
    if (std::string_view(anchor) != "start") out_.set("text-anchor", anchor);
    out_.text(text).end();
  }
  void put_edge(std::size_t i) {
    take(i);
    const auto& g = g_.groups[at(order_[i])];
    if (g.parent < 0) return;
    const auto p = place(node_of_[at(g.parent)]), q = place(i);
    const double bend = p.y + box() / 2 + 0.5 * font_, middle = q.y - box() / 2 - 1.25 * font_;
    out_.begin("path").set(
        "d", "M" + decimal(p.x) + " " + decimal(p.y) + "V" + decimal(bend) + "H" + decimal(q.x) + "V" + decimal(q.y));
    out_.set("stroke", "#2b3a4a").set("stroke-width", 0.35).end();
    const auto& j = scene_.joints[at(g.joint)];
    out_.begin("circle")
        .set("cx", q.x)
        .set("cy", middle)
        .set("r", radius())
        .set("fill", "#fff")
        .set("stroke", "#2b3a4a");
    out_.set("stroke-width", 0.35).element("title", j.type + " " + j.name).end();
    out_.begin("text").set("x", q.x).set("y", middle + 0.3 * font_).set("text-anchor", "middle").set("fill", "#000");
    out_.set("font-size", 0.85 * font_).text(joint_letter(j.kind)).end();
    const double x = q.x + radius() + 0.3 * font_;
    const auto acts = acts_of(g);
    put_text({x, middle + (acts.empty() ? 0.35 : -0.1) * font_}, "start", joint_name(g), 1, "#000");
    if (!acts.empty()) put_text({x, middle + 0.85 * font_}, "start", acts, 0.8, "#b84d00");
  }
  /// Remembers where the texts of a node are.
  void take(std::size_t i) {
    const auto p = place(i);
    taken_.push_back({p.x - half_width(i), p.x + half_width(i), p.y - box() / 2, p.y + box() / 2});
    if (g_.groups[at(order_[i])].parent >= 0)
      taken_.push_back({p.x - radius(), p.x + tree_[i].right, p.y - box() / 2 - 2.2 * font_, p.y - box() / 2});
  }
  void put_box(std::size_t i) {
    const auto& g = g_.groups[at(order_[i])];
    const auto p = place(i);
    const bool ground = order_[i] == 0;
    out_.begin("rect").set("x", p.x - half_width(i)).set("y", p.y - box() / 2).set("width", 2 * half_width(i));
    out_.set("height", box()).set("rx", ground ? 0 : 0.5 * font_).set("stroke", "#2b3a4a").set("stroke-width", 0.3);
    out_.set("fill", ground ? "#d9d9d9" : g.mass > 0 ? "#fbe5bd" : "#fff");
    std::string about = joined(g.frames);
    if (g.mass > 0) about += (about.empty() ? "" : "; ") + four_digits(g.mass) + " kg";
    if (!g.loads.empty()) about += (about.empty() ? "" : "; ") + joined(g.loads);
    if (!about.empty()) out_.element("title", about);
    out_.end();
    out_.begin("text").set("x", p.x).set("y", p.y + 0.35 * font_).set("text-anchor", "middle").set("fill", "#000");
    out_.text(name_of(g)).end();
  }

  std::string title() const {
    const std::string of = o_.title.empty() ? scene_.title : o_.title;
    return of.empty() ? "The topology of a mechanism" : of;
  }
  std::string description() const {
    std::string s;
    for (const int i : order_) {
      const auto& g = g_.groups[at(i)];
      if (g.parent >= 0)
        s += name_of(g) + " on " + name_of(g_.groups[at(g.parent)]) + " by " + joint_name(g) + " (" +
             scene_.joints[at(g.joint)].kind + "). ";
    }
    for (std::size_t i = 0; i < g_.ties.size(); ++i)
      s += tie_name(i) + " between " + name_of(g_.groups[at(g_.ties[i].from)]) + " and " +
           name_of(g_.groups[at(g_.ties[i].to)]) + ". ";
    return s.empty() ? "It has no joints." : s;
  }

  const scene& scene_;
  const rigid_groups& g_;
  const topology_options& o_;
  double font_, left_ = 0;
  std::vector<int> order_;            ///< groups by nodes
  std::vector<std::size_t> node_of_;  ///< nodes by groups
  std::vector<tidy_tree::node> tree_;
  struct rectangle {
    double left, right, low, high;
  };
  std::vector<rectangle> taken_;  ///< by texts
  svg_writer out_;
};

}  // namespace kte::detail::svg
