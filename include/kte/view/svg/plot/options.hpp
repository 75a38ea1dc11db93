#pragma once

#include <kte/view/svg/plot/column_units.hpp>

#include <limits>
#include <string>
#include <vector>

namespace kte {

/// Which curves share a panel.
enum class panels {
  by_unit,   ///< curves of one quantity: all angles, all velocities
  together,  ///< all curves in one panel
  each       ///< a panel per curve
};

/// Options of a plot: `kte::write_plot("run.svg", run, {"elbow", "elbow/v"}, {.width = 85})`.
struct plot_options {
  double width = 170;    ///< mm: journals have columns of 85 mm and pages of 170 mm
  double height = 0;     ///< mm; 0: as high as the panels need
  double font_size = 8;  ///< points of 1/72 inch
  std::string font = "sans-serif";
  std::string title{};    ///< above the picture, and for screen readers
  std::string against{};  ///< the column on the horizontal axis; empty for the first one, the time
  std::string label{};    ///< of the vertical axes, instead of the name or quantity; the unit is appended
  unit_map units{};       ///< units of coordinates, inputs, or columns that do not follow from their names
  panels share = panels::by_unit;
  bool log_x = false, log_y = false;                       ///< whether an axis is logarithmic
  double from = -std::numeric_limits<double>::infinity();  ///< rows below it on the horizontal axis are omitted,
  double to = std::numeric_limits<double>::infinity();     ///< and those above this
  bool dashed = true;                                      ///< whether curves differ by dashes in addition to colours
  bool grid = true;
};

}  // namespace kte
