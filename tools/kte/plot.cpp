#include <kte/io/table_reader.hpp>
#include <kte/view/svg/plot.hpp>

#include "commands.hpp"
#include "message.hpp"
#include "png.hpp"
#include "recorded_scene.hpp"
#include "state_input.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

struct plot_options {
  std::string recording, out, of;
  std::vector<std::string> columns;
  std::optional<double> from, to, height, dpi;
  kte::plot_options plot;
  bool each = false, one = false;
};

/// Units of the coordinates of a file, as recordings call them.
kte::unit_map units_of(const std::string& file) {
  reading in;
  in.file = file;
  const auto m = read_mechanism(in);
  const evaluate::column_order order(kte::layout(m.chain()), coordinates_of(m, m.chain()));
  kte::unit_map units;
  for (const auto& c : scene_of(m, {}).coordinates) {
    if (c.size != 1 || (c.kind != "angle" && c.kind != "length")) continue;
    units[table_name(c.name)] = c.unit;
    for (std::size_t i = 0; i < order.q.size(); ++i)
      if (order.q[i] == c.q) units["q_" + std::to_string(i)] = c.unit;
  }
  return units;
}

int plot(plot_options& o) {
  if (o.each && o.one) throw usage_error("--each and --one are one too many");
  if (o.each || o.one) o.plot.share = o.each ? kte::panels::each : kte::panels::together;
  if (o.from) o.plot.from = *o.from;
  if (o.to) o.plot.to = *o.to;
  if (o.out.empty()) o.out = std::filesystem::path(o.recording).stem().string() + ".svg";
  const auto extension = kte::detail::lower_extension(o.out);
  const bool png = extension == ".png";
  if (!png && extension != ".svg")
    throw usage_error("'" + o.out + "' is no name of a picture: these end in .svg or .png");
  if (!png && o.dpi) throw usage_error("--dpi is of PNG");
  if (o.dpi && !(*o.dpi >= 10 && *o.dpi <= 2400))
    throw usage_error("--dpi is between 10 and 2400, not " + short_number(*o.dpi));
  if (!o.of.empty()) o.plot.units = units_of(o.of);
  const auto svg = [&o, table = kte::read_table(o.recording)] {
    try {
      return kte::plot(table, o.columns, o.plot);
    } catch (const kte::unknown_name& e) {
      throw kte::bad_file("kte: " + o.recording + ": " + std::string(e.what()).substr(5));
    }
  }();
  if (png)
    write_png(o.out, svg, o.dpi.value_or(300));
  else
    kte::detail::replace_file(o.out, svg);
  say("wrote " + o.out);
  return 0;
}

}  // namespace

void add_plot(command_line& line) {
  const auto o = std::make_shared<plot_options>();
  line.add("plot", "columns of a recording as SVG or PNG",
           "Plots columns of a recording over time, as SVG or PNG with units on its axes. The name of a vector stands "
           "for its components; without names all columns are plotted. PNG needs the program rsvg-convert (Debian: "
           "librsvg2-bin).")
      .word("RECORDING", o->recording, "a table: .csv, .npy, .mcap, .ssv, .tsv")
      .words("COLUMNS", o->columns, "names of columns, as elbow, elbow/v, tool/position")
      .text("-o,--output", "FILE", o->out,
            "the picture, .svg or .png; if left out the name of the recording, with .svg")
      .text("--of", "FILE", o->of, "the mechanism that was recorded: coordinates then have units")
      .text("--against", "COLUMN", o->plot.against, "on the horizontal axis, in place of the time")
      .text("--title", "TEXT", o->plot.title, "above the picture")
      .number("--width", "MM", o->plot.width, "170 mm if left out, a page; 85 mm is a column of a journal")
      .number("--height", "MM", o->plot.height, "if left out as its panels want")
      .number("--dpi", "N", o->dpi, "of PNG, dots per inch; 300 if left out")
      .number("--from", "X", o->from, "where the horizontal axis begins")
      .number("--to", "X", o->to, "and ends")
      .flag("--each", o->each, "a panel for each column, in place of one for each quantity")
      .flag("--one", o->one, "one panel for all")
      .flag("--log-x", o->plot.log_x, "a logarithmic horizontal axis")
      .flag("--log-y", o->plot.log_y, "logarithmic vertical axes")
      .runs([o] { return plot(*o); });
}

}  // namespace kte_tool
