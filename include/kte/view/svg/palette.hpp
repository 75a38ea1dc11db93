#pragma once

#include <array>
#include <cstddef>

/// Line styles that are distinguishable, also for colour-blind people and in grey.
namespace kte::detail::svg {

/// The palette of Okabe and Ito, which has no two colours that look alike to the colour-blind; without its yellow,
/// which does not show on white.
inline constexpr std::array palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000", "#e69f00", "#56b4e9"};

/// Dashes and gaps in turn, in widths of the line; 0 at the first where the line is whole.
using dash_lengths = std::array<double, 4>;
inline constexpr std::array<dash_lengths, 5> dashes{
    {{}, {4, 2, 4, 2}, {1.2, 1.6, 1.2, 1.6}, {6, 2, 1.2, 2}, {10, 3, 10, 3}}};

/// How a curve is drawn.
struct line_style {
  const char* colour;
  dash_lengths dash;
  double width;  ///< mm
};
/// The style of curve number i: the first 70 are different.
constexpr line_style style_of(std::size_t i) {
  constexpr std::size_t all = palette.size() * dashes.size();  // their numbers have no common divisor
  return {palette[i % palette.size()], dashes[i % dashes.size()], i / all % 2 == 0 ? 0.35 : 0.7};
}

}  // namespace kte::detail::svg
