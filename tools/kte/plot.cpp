#include <kte/io/table_reader.hpp>
#include <kte/view/svg/plot.hpp>

#include "commands.hpp"
#include "message.hpp"

namespace kte_tool {

namespace {

struct plot_options {
  std::string recording, out, width;
  std::vector<std::string> columns;
  std::optional<double> from, to, height;
  kte::plot_options plot;
  bool each = false, one = false;
};

int plot(plot_options& o) {
  if (o.each && o.one) throw usage_error("--each and --one are one too many");
  if (o.each || o.one) o.plot.share = o.each ? kte::panels::each : kte::panels::together;
  if (o.from) o.plot.from = *o.from;
  if (o.to) o.plot.to = *o.to;
  if (o.out.empty()) o.out = std::filesystem::path(o.recording).stem().string() + ".svg";
  const auto extension = kte::detail::lower_extension(o.out);
  if (extension != ".svg")
    throw kte::bad_argument("kte: '" + o.out +
                            "': pictures are SVG, and end in .svg; programs like rsvg-convert make "
                            "others of them");
  kte::write_plot(o.out, kte::read_table(o.recording), o.columns, o.plot);
  say("wrote " + o.out);
  return 0;
}

}  // namespace

void add_plot(command_line& line) {
  const auto o = std::make_shared<plot_options>();
  line.add("plot", "columns of a recording as SVG",
           "Plots columns of a recording over time, as SVG with units on its axes. The name of a vector stands for its "
           "components; without names all columns are plotted.")
      .word("RECORDING", o->recording, "a table: .csv, .npy, .mcap, .ssv, .tsv")
      .words("COLUMNS", o->columns, "names of columns, as elbow, elbow/v, tool/position")
      .text("-o,--output", "FILE", o->out, "the picture; if left out the name of the recording, with .svg")
      .text("--against", "COLUMN", o->plot.against, "on the horizontal axis, in place of the time")
      .text("--title", "TEXT", o->plot.title, "above the picture")
      .number("--width", "MM", o->plot.width, "170 mm if left out, a page; 85 mm is a column of a journal")
      .number("--height", "MM", o->plot.height, "if left out as its panels want")
      .number("--from", "X", o->from, "where the horizontal axis begins")
      .number("--to", "X", o->to, "and ends")
      .flag("--each", o->each, "a panel for each column, in place of one for each quantity")
      .flag("--one", o->one, "one panel for all")
      .flag("--log-x", o->plot.log_x, "a logarithmic horizontal axis")
      .flag("--log-y", o->plot.log_y, "logarithmic vertical axes")
      .runs([o] { return plot(*o); });
}

}  // namespace kte_tool
