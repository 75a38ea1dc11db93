#include "png.hpp"

#include <kte/io/replace_file.hpp>

#include "other_program.hpp"
#include "private_folder.hpp"
#include "text_format.hpp"

namespace kte_tool {

void write_png(const std::filesystem::path& file, const std::string& svg, double dpi) {
  const private_folder folder("kte-plot");
  const auto from = folder.path() / "plot.svg", to = folder.path() / "plot.png";
  kte::detail::replace_file(from, svg);
  const auto resolution = short_number(dpi);
  const auto end = run_other("rsvg-convert",
                             {"--format=png", "--background-color=white", "--dpi-x=" + resolution,
                              "--dpi-y=" + resolution, "--output=" + to.string(), from.string()},
                             "it makes PNG (Debian: librsvg2-bin), SVG is written without it");
  std::error_code none;
  if (end.code != 0 || !std::filesystem::exists(to, none))
    throw kte::bad_file("kte: cannot write '" + file.string() + "': rsvg-convert ended " + end.how);
  kte::detail::replace_file(file, kte::detail::read_file(to));
}

}  // namespace kte_tool
