#include <kte/io/table_reader.hpp>
#include <kte/view/svg/plot.hpp>

#include "commands.hpp"
#include "message.hpp"
#include "output_file.hpp"
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
  if (o.each && o.one) throw usage_error("--each and --one exclude each other");
  if (o.each || o.one) o.plot.share = o.each ? kte::panels::each : kte::panels::together;
  if (o.from) o.plot.from = *o.from;
  if (o.to) o.plot.to = *o.to;
  if (o.out.empty()) o.out = std::filesystem::path(o.recording).stem().string() + ".svg";
  const auto extension = kte::detail::lower_extension(o.out);
  const bool png = extension == ".png";
  if (!png && extension != ".svg")
    throw usage_error("'" + o.out + "' is not the name of a picture: these end in .svg or .png");
  if (!png && o.dpi) throw usage_error("--dpi is of PNG");
  if (o.dpi && !(*o.dpi >= 10 && *o.dpi <= 2400))
    throw usage_error("--dpi is between 10 and 2400, not " + short_number(*o.dpi));
  refuse_input_as_output({"-o", o.out}, {{"RECORDING", o.recording}, {"--of", o.of}});
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
  line.add("plot", "plots columns of a recording as SVG or PNG",
           "Plots columns of a recording over time, as SVG or PNG with units on its axes. The name of a vector selects "
           "its components; without names all columns are plotted. PNG needs the program rsvg-convert (Debian: "
           "librsvg2-bin).")
      .word("RECORDING", o->recording, "a table: .csv, .npy, .mcap, .ssv, .tsv")
      .words("COLUMNS", o->columns, "names of columns, such as elbow, elbow/v, tool/position")
      .text("-o,--output", "FILE", o->out, "the picture, .svg or .png; default: the name of the recording with .svg")
      .text("--of", "FILE", o->of, "file of the recorded mechanism, from which units of coordinates are known")
      .text("--against", "COLUMN", o->plot.against, "column on the horizontal axis; default: the time")
      .text("--title", "TEXT", o->plot.title, "title above the picture")
      .number("--width", "MM", o->plot.width, "default 170, the width of a page; 85 is a journal column")
      .number("--height", "MM", o->plot.height, "default: chosen by the number of panels")
      .number("--dpi", "N", o->dpi, "resolution of PNG, dots per inch; default 300")
      .number("--from", "X", o->from, "start of the horizontal axis")
      .number("--to", "X", o->to, "end of the horizontal axis")
      .flag("--each", o->each, "one panel per column; default: one per quantity")
      .flag("--one", o->one, "one panel for all columns")
      .flag("--log-x", o->plot.log_x, "logarithmic horizontal axis")
      .flag("--log-y", o->plot.log_y, "logarithmic vertical axes")
      .runs([o] { return plot(*o); });
}

}  // namespace kte_tool
