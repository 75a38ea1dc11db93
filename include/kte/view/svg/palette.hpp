#pragma once

#include <array>
#include <cstddef>

/// Line styles that are distinguishable for colour-blind readers, and in grey.
namespace kte::detail::svg {

/// The palette of Okabe and Ito, which is distinguishable for colour-blind readers, without its yellow, which is too
/// pale on white.
inline constexpr std::array palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"};

/// Alternating lengths of dashes and gaps, in line widths; the first is 0 for a solid line.
using dash_lengths = std::array<double, 4>;
inline constexpr std::array<dash_lengths, 5> dashes{
    {{}, {4, 2, 4, 2}, {1.2, 1.6, 1.2, 1.6}, {6, 2, 1.2, 2}, {10, 3, 10, 3}}};

/// The style of a curve.
struct line_style {
  const char* colour;
  dash_lengths dash;
  double width;  ///< mm
};
/// The style of curve number i: the first 70 are different.
constexpr line_style style_of(std::size_t i) {
  constexpr std::size_t all = palette.size() * dashes.size();  // the two sizes are coprime
  return {palette[i % palette.size()], dashes[i % dashes.size()], i / all % 2 == 0 ? 0.35 : 0.7};
}

}  // namespace kte::detail::svg
