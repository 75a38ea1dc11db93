#pragma once

#include <kte/view/svg/plot/axis_label.hpp>
#include <kte/view/svg/plot/layout.hpp>

/// Draws the layout of a plot as SVG.
namespace kte::detail::svg {

class plot_drawing {
 public:
  plot_drawing(const plot_layout& layout, const plot_options& options) : l_(layout), o_(options) {}

  std::string text() {
    begin_picture(out_, o_.width, l_.height, o_.font, l_.font, o_.title.empty() ? title() : o_.title, description());
    if (!o_.title.empty())
      put_text({(l_.left + l_.right) / 2, 1.5 * l_.font}, "middle",
               {shortened(o_.title, (l_.right - l_.left) / l_.font)});
    for (const auto& p : l_.all) put(p);
    put_horizontal_labels();
    out_.end();
    return out_.document();
  }

 private:
  std::string title() const {
    std::string names;
    for (const auto& p : l_.all)
      for (const auto& c : p.panel.columns) names.append(names.empty() ? "" : ", ").append(shortened(c.name, 30));
    return names + " against " + shortened(l_.against.name, 30);
  }
  static std::string with_unit(double x, const std::string& unit) {
    return four_digits(x) + (unit.empty() ? "" : " " + unit);
  }
  std::string description() const {
    std::string s = "Curves against ";
    s.append(shortened(l_.against.name, 30)).append(" from ");
    s += with_unit(l_.across->range().low, l_.against.meaning.unit) + " to " +
         with_unit(l_.across->range().high, l_.against.meaning.unit) + ".";
    for (const auto& p : l_.all)
      for (std::size_t i = 0; i < p.panel.columns.size(); ++i) {
        const auto& c = p.panel.columns[i];
        const auto& range = p.curves.ranges[i];
        s.append(" ").append(shortened(c.name, 30));
        s += (range.empty() ? " has no numbers to show."
                            : " is between " + with_unit(range.low, c.meaning.unit) + " and " +
                                  with_unit(range.high, c.meaning.unit) + ".");
      }
    return s;
  }

  void put_line(picture_point a, picture_point b, const char* colour, double width) {
    out_.begin("path").set("d", "M" + decimal(a.x) + " " + decimal(a.y) + "L" + decimal(b.x) + " " + decimal(b.y));
    out_.set("stroke", colour).set("stroke-width", width).end();
  }
  void put_text(picture_point at, const char* anchor, const raised_text& text, bool upwards = false) {
    out_.begin("text").set("fill", "#000").set("text-anchor", anchor);
    if (upwards)
      out_.set("transform", "translate(" + decimal(at.x) + " " + decimal(at.y) + ")rotate(-90)");
    else
      out_.set("x", at.x).set("y", at.y);
    put_raised(out_, text, l_.font);
    out_.end();
  }

  void put(const placed_panel& p) {
    const auto& up = *p.up;
    const double low = up.from(), high = up.to();
    for (const auto& mark : p.ticks.ticks) {
      const double y = up(mark.value);
      const bool large = mark.label.width() > 0;
      if (large && o_.grid) put_line({l_.left, y}, {l_.right, y}, "#e3e3e3", 0.15);
      put_line({l_.left - (large ? 1 : 0.6), y}, {l_.left, y}, "#000", 0.2);
      if (large) put_text({l_.left - 1.6, y + 0.36 * l_.font}, "end", mark.label);
    }
    for (const auto& mark : l_.across_ticks.ticks) {
      const double x = (*l_.across)(mark.value);
      const bool large = mark.label.width() > 0;
      if (large && o_.grid) put_line({x, low}, {x, high}, "#e3e3e3", 0.15);
      put_line({x, low}, {x, low + (large ? 1 : 0.6)}, "#000", 0.2);
    }
    for (std::size_t i = 0; i < p.panel.columns.size(); ++i) put_curve(p, i);
    out_.begin("path").set("d",
                           "M" + decimal(l_.left) + " " + decimal(high) + "V" + decimal(low) + "H" + decimal(l_.right));
    out_.set("stroke", "#000").set("stroke-width", 0.25).set("stroke-linecap", "square").end();
    const auto& first = p.panel.columns.front();
    const std::string name = !o_.label.empty()             ? o_.label
                             : p.panel.columns.size() == 1 ? first.name
                                                           : p.panel.meaning.quantity;
    auto label = axis_label(name, p.panel.meaning.unit, p.ticks);
    const double room = (low - high) / l_.font + 1;
    if (label.width() > room)
      label = axis_label(shortened(name, room - label.width() + text_width(name)), p.panel.meaning.unit, p.ticks);
    put_text({1.3 * l_.font, (low + high) / 2}, "middle", label, true);
    if (p.names) p.names->put(out_, l_.left, p.legend_top, o_.dashed);
    if (const auto note = p.curves.note(); !note.empty()) {
      const double width = (text_width(note) + 1) * l_.font;
      out_.begin("rect").set("x", l_.right - width).set("y", high).set("width", width).set("height", 1.4 * l_.font);
      out_.set("fill", "#fff").set("fill-opacity", 0.85).end();
      out_.begin("text").set("x", l_.right - 0.5 * l_.font).set("y", high + l_.font).set("text-anchor", "end");
      out_.set("fill", "#595959").text(note).end();
    }
  }
  void put_curve(const placed_panel& p, std::size_t i) {
    const auto& path = p.curves.paths[i];
    const auto style = style_of(i);
    out_.begin("g").element("title", p.panel.columns[i].name);
    if (const auto d = path.text(); !d.empty()) {
      out_.begin("path").set("d", d);
      set_style(out_, style, o_.dashed);
      out_.end();
    }
    for (const auto& dot : path.dots)
      out_.begin("circle")
          .set("cx", dot.x)
          .set("cy", dot.y)
          .set("r", 1.4 * style.width)
          .set("fill", style.colour)
          .end();
    out_.end();
  }
  void put_horizontal_labels() {
    const double low = l_.all.back().up->from();
    for (const auto& mark : l_.across_ticks.ticks)
      if (mark.label.width() > 0) put_text({(*l_.across)(mark.value), low + 1.4 + l_.font}, "middle", mark.label);
    const std::string name = shortened(l_.against.name, (l_.right - l_.left) / l_.font - 10);
    put_text({(l_.left + l_.right) / 2, low + 1.4 + 2.5 * l_.font}, "middle",
             axis_label(name, l_.against.meaning.unit, l_.across_ticks));
  }

  const plot_layout& l_;
  const plot_options& o_;
  svg_writer out_;
};

}  // namespace kte::detail::svg
