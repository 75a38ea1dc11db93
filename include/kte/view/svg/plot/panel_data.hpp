#pragma once

#include <kte/view/svg/plot/axis.hpp>
#include <kte/view/svg/plot/columns.hpp>
#include <kte/view/svg/plot/curve_path.hpp>

namespace kte::detail::svg {

/// Curves of one panel over an axis, and texts about numbers that are not shown.
struct panel_curves {
  std::vector<curve_path> paths;
  std::vector<number_range> ranges;
  std::size_t points = 0, infinite = 0, not_positive = 0;

  std::string note() const {
    const auto left_out = [](std::size_t n, const std::string& what) {
      return n == 0 ? "" : std::to_string(n) + " " + what + (n == 1 ? " number" : " numbers") + " not shown";
    };
    const std::string a = left_out(not_positive, "not positive"), b = left_out(infinite, "infinite");
    const std::string both = a + (a.empty() || b.empty() ? "" : ", ") + b;
    return points == 0 ? both.empty() ? "no numbers" : both : both;
  }
};

/// The drawable data of a panel, in rows with a position on the horizontal axis.
class panel_data {
 public:
  panel_data(const plot_panel& panel, const std::vector<double>& x, const plot_axis& across, bool logarithmic,
             const plot_options& o)
      : panel_(panel), x_(x), across_(across), logarithmic_(logarithmic), from_(o.from), to_(o.to) {}

  number_range range() const {
    number_range all;
    for (const auto& c : panel_.columns)
      for (std::size_t i = 0; i < x_.size(); ++i)
        if (const double y = (*c.numbers)[i]; shown(i) && has(y)) all.add(y);
    return all;
  }
  panel_curves curves(const plot_axis& up) const {
    panel_curves all;
    for (const auto& c : panel_.columns) {
      curve_path path(x_.size() > 20000);
      number_range range;
      for (std::size_t i = 0; i < x_.size(); ++i) {
        const double y = (*c.numbers)[i];
        if (!within(i)) continue;
        const bool place = across_.has(x_[i]);
        if (place && has(y)) {
          path.add({across_(x_[i]), up(y)});
          range.add(y), ++all.points;
          continue;
        }
        path.gap();
        if (std::isinf(y) || std::isinf(x_[i]))
          ++all.infinite;
        else if (!std::isnan(y) && !std::isnan(x_[i]))
          ++all.not_positive;
      }
      path.gap();
      all.paths.push_back(std::move(path)), all.ranges.push_back(range);
    }
    return all;
  }

 private:
  bool has(double y) const { return std::isfinite(y) && (!logarithmic_ || y > 0); }
  bool within(std::size_t i) const { return !(x_[i] < from_ || x_[i] > to_); }
  bool shown(std::size_t i) const { return within(i) && across_.has(x_[i]); }

  const plot_panel& panel_;
  const std::vector<double>& x_;
  const plot_axis& across_;
  bool logarithmic_;
  double from_, to_;
};

}  // namespace kte::detail::svg
