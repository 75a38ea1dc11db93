#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace kte::detail::svg {

/// The smallest and the largest of some numbers; ignores NaN and infinities.
struct number_range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  bool empty() const { return !(low <= high); }
  void add(double x) {
    if (std::isfinite(x)) low = (std::min)(low, x), high = (std::max)(high, x);
  }
  /// Whether its width is below the rounding error of its ends.
  bool is_point() const {
    return high / 2 - low / 2 <= 5e-13 * (std::max)(std::abs(low), std::abs(high)) || high / 2 - low / 2 < 1e-321;
  }
};

/// A range that an axis can show: of nonzero width, extended on both sides by a fraction of it.
inline number_range shown_range(number_range r, double part) {
  constexpr double most = (std::numeric_limits<double>::max)();
  if (r.empty()) return {0, 1};
  if (r.is_point()) {
    const double middle = r.low / 2 + r.high / 2, around = std::abs(middle) < 1e-320 ? 1 : std::abs(middle) / 10;
    return {(std::max)(middle - around, -most), (std::min)(middle + around, most)};
  }
  const double more = part * (r.high / 2 - r.low / 2) * 2;
  return {(std::max)(r.low - more, -most), (std::min)(r.high + more, most)};
}
/// The range of positive numbers on a logarithmic axis.
inline number_range shown_logarithmic_range(number_range r, double part) {
  constexpr double least = std::numeric_limits<double>::denorm_min(), most = (std::numeric_limits<double>::max)();
  if (r.empty()) return {1, 10};
  const double width = std::log10(r.high) - std::log10(r.low);
  const double factor = std::pow(10.0, width < 1e-9 ? 0.5 : part * width);
  return {(std::max)(r.low / factor, least), (std::min)(r.high * factor, most)};
}

}  // namespace kte::detail::svg
