#pragma once

#include <kte/view/svg/plot/legend.hpp>
#include <kte/view/svg/plot/panel_data.hpp>

#include <optional>

/// Positions of the parts of a plot, mm.
namespace kte::detail::svg {

/// A panel and its drawn data.
struct placed_panel {
  plot_panel panel;
  number_range shown{};
  std::optional<legend> names{};  ///< if there are several curves
  double legend_top = 0;
  std::optional<plot_axis> up{};
  tick_list ticks{};
  panel_curves curves{};
};

/// Throws `bad_argument` for invalid sizes.
inline void check_plot_options(const plot_options& o) {
  const auto refuse = [](const std::string& what) { raise<bad_argument>("kte: a plot " + what); };
  if (!(o.width >= 20 && o.width <= 2000)) refuse("is 20 to 2000 mm wide, not " + four_digits(o.width));
  if (!(o.height >= 0 && o.height <= 5000)) refuse("is at most 5000 mm high, not " + four_digits(o.height));
  if (!(o.font_size >= 1 && o.font_size * 8 <= o.width))
    refuse("of " + four_digits(o.width) + " mm has letters of 1 to " + four_digits(o.width / 8) + " points, not " +
           four_digits(o.font_size));
  if (!(o.from <= o.to))
    refuse("goes from the smaller number to the larger, not from " + four_digits(o.from) + " to " + four_digits(o.to));
}

class plot_layout {
 public:
  static constexpr double between_panels = 3.5;
  double font;  ///< size of letters
  plot_column against;
  std::vector<placed_panel> all{};
  std::optional<plot_axis> across{};
  tick_list across_ticks{};
  double left = 0, right = 0, top = 0, height = 0, panel_height = 0;

  plot_layout(const table& t, const std::vector<std::string>& names, const plot_options& o)
      : font(o.font_size * 25.4 / 72), against(plot_columns(t, o).against()) {
    for (auto& p : plot_columns(t, o).panels_of(names)) all.push_back({std::move(p)});
    const auto count = static_cast<double>(all.size());
    panel_height = o.height > 0 ? o.height / count : o.width * (all.size() == 1 ? 0.45 : 0.28);
    right = o.width - 2.2 * font, top = o.title.empty() ? font : 2.4 * font;
    place_horizontally(t, o);
    place_legends();
    double legends = 0;
    for (const auto& p : all) legends += p.names ? p.names->height() : 0;
    const double fixed = top + legends + between_panels * (count - 1) + 4.4 * font;
    if (o.height > 0) panel_height = (o.height - fixed) / count;
    if (panel_height < 2.5 * font)
      raise<bad_argument>("kte: a plot of " + std::to_string(all.size()) + " panels needs a height of " +
                          four_digits(std::ceil(fixed + 2.5 * font * count)) + " mm, not " + four_digits(o.height));
    height = fixed + panel_height * count;
    place_panels(o);
  }

 private:
  panel_data data_of(const placed_panel& p, const plot_options& o) const {
    return {p.panel, *against.numbers, *across, o.log_y, o};
  }
  std::size_t most_ticks() const { return static_cast<std::size_t>(std::clamp(panel_height / (2.4 * font), 2.0, 8.0)); }

  /// The labels of vertical axes determine the width of the panels.
  void place_horizontally(const table& t, const plot_options& o) {
    number_range x;
    bool rising = true;
    for (std::size_t i = 0; i < t.rows(); ++i) {
      const double here = (*against.numbers)[i];
      if (here < o.from || here > o.to || (o.log_x && here <= 0)) continue;
      x.add(here);
      rising = rising && here == x.high;
    }
    const double beside = rising ? 0 : 0.04;  // the time fills the width
    const auto shown = o.log_x ? shown_logarithmic_range(x, beside) : shown_range(x, beside);
    across.emplace(shown, o.log_x, 0, 1);
    double widest = 0;
    for (auto& p : all) {
      const auto y = data_of(p, o).range();
      p.shown = o.log_y ? shown_logarithmic_range(y, 0.04) : shown_range(y, 0.04);
      for (const auto& mark : plot_axis(p.shown, o.log_y, 0, 1).ticks(most_ticks()).ticks)
        widest = (std::max)(widest, mark.label.width());
    }
    left = (2.2 + widest) * font + 2;
    across.emplace(shown, o.log_x, left, right);
    across_ticks = fitting_ticks(*across, font);
  }
  void place_legends() {
    for (auto& p : all) {
      if (p.panel.columns.size() < 2) continue;
      std::vector<std::string> names;
      for (const auto& c : p.panel.columns) names.push_back(c.name);
      p.names.emplace(names, right - left, font);
    }
  }
  void place_panels(const plot_options& o) {
    double y = top;
    for (auto& p : all) {
      p.legend_top = y;
      if (p.names) y += p.names->height();
      p.up.emplace(p.shown, o.log_y, y + panel_height, y);
      p.ticks = p.up->ticks(most_ticks());
      p.curves = data_of(p, o).curves(*p.up);
      y += panel_height + between_panels;
    }
  }
};

}  // namespace kte::detail::svg
