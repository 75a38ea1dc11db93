#pragma once

#include <kte/view/svg/svg_writer.hpp>
#include <kte/view/svg/topology/layout.hpp>
#include <kte/view/svg/topology/options.hpp>

namespace kte::detail::svg {

/// The letter of a joint in mechanism theory.
inline const char* joint_letter(std::string_view kind) {
  constexpr std::pair<std::string_view, const char*> letters[]{
      {"revolute", "R"},  {"prismatic", "P"}, {"screw", "H"}, {"cylindrical", "C"}, {"universal", "U"},
      {"spherical", "S"}, {"planar", "E"},    {"free", "F"},  {"fixed", "="}};
  for (const auto& [name, letter] : letters)
    if (name == kind) return letter;
  return "?";
}

/// Draws the graph of a mechanism as SVG.
class topology_drawing {
 public:
  topology_drawing(const scene& s, const rigid_groups& g, const topology_options& o)
      : scene_(s), g_(g), o_(o), font_(o.font_size * 25.4 / 72), l_(s, g, font_) {
    if (!(o.font_size >= 1 && o.font_size <= 100 && o.width >= 0 && o.width <= 5000))
      raise<bad_argument>("kte: the topology needs letters of 1 to 100 points and a width of 0 to 5000 mm");
  }

  std::string text() {
    const double scale = o_.width > 0 ? o_.width / l_.width() : 1;
    begin_picture(out_, l_.width() * scale, l_.height() * scale, o_.font, font_, title(), description());
    out_.begin("g");
    if (scale != 1) out_.set("transform", "scale(" + four_digits(scale) + ")");
    for (std::size_t i = 0; i < g_.ties.size(); ++i) put_tie(i);
    for (std::size_t i = 0; i < l_.size(); ++i) put_edge(i);
    for (std::size_t i = 0; i < l_.size(); ++i) put_box(i);
    for (std::size_t i = 0; i < g_.ties.size(); ++i) put_tie_name(i);
    out_.end().end();
    return out_.document();
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void put_tie(std::size_t i) {
    const auto c = l_.arc(i);
    path_data d;
    d.move(c[0]), d.curve(c[1], c[2], c[3]);
    out_.begin("path").set("d", d.text()).set("stroke", colour(i)).set("stroke-width", 0.3);
    out_.set("stroke-dasharray", "1.2 0.9").element("title", joined(g_.ties[i].names)).end();
  }
  const char* colour(std::size_t tie) const { return g_.ties[tie].joint ? "#0072b2" : "#b84d00"; }
  /// The position on its arc with the least overlap with other texts.
  void put_tie_name(std::size_t i) {
    const auto c = l_.arc(i);
    const double half = l_.label_width(i), up = 0.6 * font_;
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
    put_text({best.x, best.y + 0.3 * font_}, "middle", l_.tie_name(i), 0.8, colour(i));
  }
  /// On a white background, because lines may be below.
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
    const auto& g = l_.group(i);
    if (g.parent < 0) return;
    const auto p = l_.place(l_.node_of(g.parent)), q = l_.place(i);
    const double bend = p.y + l_.box() / 2 + 0.5 * font_, middle = q.y - l_.box() / 2 - 1.25 * font_;
    out_.begin("path").set(
        "d", "M" + decimal(p.x) + " " + decimal(p.y) + "V" + decimal(bend) + "H" + decimal(q.x) + "V" + decimal(q.y));
    out_.set("stroke", "#2b3a4a").set("stroke-width", 0.35).end();
    const auto& j = scene_.joints[at(g.joint)];
    out_.begin("circle")
        .set("cx", q.x)
        .set("cy", middle)
        .set("r", l_.radius())
        .set("fill", "#fff")
        .set("stroke", "#2b3a4a");
    out_.set("stroke-width", 0.35).element("title", j.type + " " + j.name).end();
    out_.begin("text").set("x", q.x).set("y", middle + 0.3 * font_).set("text-anchor", "middle").set("fill", "#000");
    out_.set("font-size", 0.85 * font_).text(joint_letter(j.kind)).end();
    const double x = q.x + l_.radius() + 0.3 * font_;
    const auto acts = l_.acts_of(g);
    put_text({x, middle + (acts.empty() ? 0.35 : -0.1) * font_}, "start", l_.joint_name(g), 1, "#000");
    if (!acts.empty()) put_text({x, middle + 0.85 * font_}, "start", acts, 0.8, "#b84d00");
  }
  /// Marks the area of the texts of a node as occupied.
  void take(std::size_t i) {
    const auto p = l_.place(i);
    taken_.push_back({p.x - l_.half_width(i), p.x + l_.half_width(i), p.y - l_.box() / 2, p.y + l_.box() / 2});
    if (l_.group(i).parent >= 0)
      taken_.push_back(
          {p.x - l_.radius(), p.x + l_.node(i).right, p.y - l_.box() / 2 - 2.2 * font_, p.y - l_.box() / 2});
  }
  void put_box(std::size_t i) {
    const auto& g = l_.group(i);
    const auto p = l_.place(i);
    const bool ground = g.parent < 0 && g.mass == 0;
    out_.begin("rect").set("x", p.x - l_.half_width(i)).set("y", p.y - l_.box() / 2).set("width", 2 * l_.half_width(i));
    out_.set("height", l_.box()).set("rx", ground ? 0 : 0.5 * font_).set("stroke", "#2b3a4a").set("stroke-width", 0.3);
    out_.set("fill", ground ? "#d9d9d9" : g.mass > 0 ? "#fbe5bd" : "#fff");
    std::string about = joined(g.frames);
    if (g.mass > 0) about += (about.empty() ? "" : "; ") + four_digits(g.mass) + " kg";
    if (!g.loads.empty()) about += (about.empty() ? "" : "; ") + joined(g.loads);
    if (!about.empty()) out_.element("title", about);
    out_.end();
    out_.begin("text").set("x", p.x).set("y", p.y + 0.35 * font_).set("text-anchor", "middle").set("fill", "#000");
    out_.text(l_.name_of(g)).end();
  }

  std::string title() const {
    const std::string of = o_.title.empty() ? scene_.title : o_.title;
    return of.empty() ? "The topology of a mechanism" : of;
  }
  std::string description() const {
    std::string s;
    for (std::size_t i = 0; i < l_.size(); ++i) {
      const auto& g = l_.group(i);
      if (g.parent >= 0)
        s += l_.name_of(g) + " on " + l_.name_of(g_.groups[at(g.parent)]) + " by " + l_.joint_name(g) + " (" +
             scene_.joints[at(g.joint)].kind + "). ";
    }
    for (std::size_t i = 0; i < g_.ties.size(); ++i)
      s += l_.tie_name(i) + " between " + l_.name_of(g_.groups[at(g_.ties[i].from)]) + " and " +
           l_.name_of(g_.groups[at(g_.ties[i].to)]) + ". ";
    return s.empty() ? "It has no joints." : s;
  }

  const scene& scene_;
  const rigid_groups& g_;
  const topology_options& o_;
  double font_;
  topology_layout l_;
  struct rectangle {
    double left, right, low, high;
  };
  std::vector<rectangle> taken_;  ///< occupied by texts
  svg_writer out_;
};

}  // namespace kte::detail::svg
