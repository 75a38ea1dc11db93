#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/view/svg/plot/drawing.hpp>

namespace kte {

/// Plots columns of a table against the first column, or against another. Returns SVG 1.1 as text.
///
///   kte::write_plot("out.svg", kte::read_table("run.csv"), {"elbow", "elbow/v", "tool/position"}, {.width = 85});
///
/// The name of a vector stands for its components; without names all columns are plotted. Units follow from the names
/// of recorders; those of coordinates and inputs are given by `plot_options::units`. NaN is a gap. Infinities, and on
/// logarithmic axes numbers that are not positive, are omitted and counted in the picture. Curves with many points have
/// the minimum and maximum of each tenth of a mm.
///
/// Throws `unknown_name` for a column that does not exist, `bad_argument` for a table without columns or with columns
/// of different lengths, and invalid sizes.
[[nodiscard]] inline std::string plot(const table& t, const std::vector<std::string>& columns = {},
                                      const plot_options& o = {}) {
  using namespace detail::svg;
  check_plot_options(o);
  const plot_layout layout(t, columns, o);
  return plot_drawing(layout, o).text();
}

/// Writes a plot to a file, which is replaced after all is written. Throws `bad_file` if it cannot be written.
inline void write_plot(const std::filesystem::path& file, const table& t, const std::vector<std::string>& columns = {},
                       const plot_options& o = {}) {
  detail::replace_file(file, plot(t, columns, o));
}

}  // namespace kte
