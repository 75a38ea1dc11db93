#pragma once

#include <kte/view/svg/plot/number_range.hpp>
#include <kte/view/svg/plot/ticks.hpp>

namespace kte::detail::svg {

/// One axis of a panel: maps numbers to positions, mm.
class plot_axis {
 public:
  /// `from`, `to`: positions of the low and the high end of the range.
  plot_axis(number_range shown, bool logarithmic, double from, double to)
      : range_(shown), logarithmic_(logarithmic), from_(from), to_(to) {
    std::frexp((std::max)(std::abs(shown.low), std::abs(shown.high)), &power_);
    low_ = scaled(shown.low), width_ = scaled(shown.high) - low_;
  }

  const number_range& range() const { return range_; }
  double from() const { return from_; }
  double to() const { return to_; }
  /// Whether a number has a position.
  bool has(double x) const { return std::isfinite(x) && (!logarithmic_ || x > 0); }
  double operator()(double x) const { return from_ + (scaled(x) - low_) / width_ * (to_ - from_); }
  tick_list ticks(std::size_t most) const {
    return logarithmic_ ? logarithmic_ticks(range_.low, range_.high, most)
                        : linear_ticks(range_.low, range_.high, most);
  }

 private:
  /// Linear axes scale exactly, to numbers of about 1, so that no difference overflows.
  double scaled(double x) const { return logarithmic_ ? std::log10(x) : std::ldexp(x, -power_); }

  number_range range_;
  bool logarithmic_;
  double from_, to_;
  int power_ = 0;
  double low_ = 0, width_ = 1;
};

/// As many ticks of a horizontal axis as fit with their labels, for a font size in mm, with gaps of two digits.
inline tick_list fitting_ticks(const plot_axis& axis, double font_size) {
  const double length = std::abs(axis.to() - axis.from());
  for (std::size_t most = 10;; --most) {
    auto list = axis.ticks(most);
    double widest = 0, count = 0;
    for (const auto& t : list.ticks)
      if (const double w = t.label.width(); w > 0) widest = (std::max)(widest, w), ++count;
    if (most == 1 || (widest + 1.2) * font_size * (count - 1) <= length) return list;
  }
}

}  // namespace kte::detail::svg
