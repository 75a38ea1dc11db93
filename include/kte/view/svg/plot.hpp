#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/view/svg/plot/drawing.hpp>

namespace kte {

/// Columns of a table against the first one, or against another, as a picture: SVG 1.1, a text.
///
///   kte::write_plot("out.svg", kte::read_table("run.csv"), {"elbow", "elbow/v", "tool/position"}, {.width = 85});
///
/// The name of a vector stands for its components; without names all columns are plotted. Units are those that
/// recorders mean by their names; those of coordinates and inputs are given by `plot_options::units`. NaN is a gap;
/// infinities, and on logarithmic axes all that is not positive, are left out and counted in the picture. Curves of
/// many points have the least and the largest of each tenth of a mm.
///
/// Throws `unknown_name` for a column that is not there, `bad_argument` for a table without columns or with columns of
/// different lengths, and sizes that give no picture.
[[nodiscard]] inline std::string plot(const table& t, const std::vector<std::string>& columns = {},
                                      const plot_options& o = {}) {
  using namespace detail::svg;
  check_plot_options(o);
  const plot_layout layout(t, columns, o);
  return plot_drawing(layout, o).text();
}

/// The same in a file, which is replaced only when all is written. Throws `bad_file` where that cannot be.
inline void write_plot(const std::filesystem::path& file, const table& t, const std::vector<std::string>& columns = {},
                       const plot_options& o = {}) {
  detail::replace_file(file, plot(t, columns, o));
}

}  // namespace kte
