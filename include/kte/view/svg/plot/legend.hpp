#pragma once

#include <kte/view/svg/palette.hpp>
#include <kte/view/svg/svg_writer.hpp>
#include <kte/view/svg/text_width.hpp>

namespace kte::detail::svg {

/// Sets the style of a curve.
inline void set_style(svg_writer& out, const line_style& s, bool dashed) {
  out.set("stroke", s.colour).set("stroke-width", s.width);
  if (!dashed || s.dash[0] == 0) return;
  std::string lengths;
  for (const double d : s.dash) lengths.append(lengths.empty() ? "" : " ").append(decimal(d * s.width));
  out.set("stroke-dasharray", lengths).set("stroke-linecap", "butt");
}

/// Names of curves with line samples, in rows of equal columns.
class legend {
 public:
  static constexpr double sample = 6, gap = 1;  ///< of line samples, mm

  legend(const std::vector<std::string>& names, double width, double font_size) : font_size_(font_size) {
    for (const auto& n : names) {
      names_.push_back(shortened(n, (std::min)((width - sample - gap) / font_size, 40.0)));
      column_ = (std::max)(column_, sample + gap + (text_width(names_.back()) + 1) * font_size);
    }
    columns_ = (std::max)(static_cast<std::size_t>(width / column_), std::size_t{1});
  }
  double height() const {
    const std::size_t rows = (names_.size() + columns_ - 1) / columns_;
    return static_cast<double>(rows) * row_height() + 0.4 * font_size_;
  }
  void put(svg_writer& out, double left, double top, bool dashed) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::size_t column = i % columns_, row = i / columns_;
      const double x = left + column_ * static_cast<double>(column),
                   y = top + row_height() * (static_cast<double>(row) + 0.5);
      out.begin("path").set("d", "M" + decimal(x) + " " + decimal(y) + "h" + decimal(sample));
      set_style(out, style_of(i), dashed);
      out.end();
      out.begin("text").set("x", x + sample + gap).set("y", y + 0.36 * font_size_).set("fill", "#000");
      out.text(names_[i]).end();
    }
  }

 private:
  double row_height() const { return 1.35 * font_size_; }

  double font_size_, column_ = 1;
  std::size_t columns_ = 1;
  std::vector<std::string> names_;
};

}  // namespace kte::detail::svg
