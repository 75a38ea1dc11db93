#pragma once

#include <kte/view/svg/svg_writer.hpp>
#include <kte/view/svg/text_width.hpp>

namespace kte::detail::svg {

/// A text with an exponent: "energy (10", "-9", " J)".
struct raised_text {
  std::string before, exponent{}, after{};

  static constexpr double raised_size = 0.7;  ///< of exponents, relative to the font size
  /// In units of the font size.
  double width() const { return text_width(before) + raised_size * text_width(exponent) + text_width(after); }
  std::string plain() const { return before + (exponent.empty() ? "" : "^" + exponent) + after; }
};

/// Appends the text to an open text element, with a font size in mm. (`baseline-shift` is not supported everywhere.)
inline void put_raised(svg_writer& out, const raised_text& t, double font_size) {
  out.text(t.before);
  if (t.exponent.empty()) return;
  out.begin("tspan").set("font-size", raised_text::raised_size * font_size).set("dy", -0.35 * font_size);
  out.text(t.exponent).end();
  if (!t.after.empty()) out.begin("tspan").set("dy", 0.35 * font_size).text(t.after).end();
}

/// An integer for readers, with a minus sign instead of a hyphen.
inline std::string signed_text(long long n) { return (n < 0 ? "−" : "") + std::to_string(n < 0 ? -n : n); }

}  // namespace kte::detail::svg
