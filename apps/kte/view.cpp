#include <kte/io/table_reader.hpp>
#include <kte/view/write_page.hpp>

#include "browser.hpp"
#include "commands.hpp"
#include "message.hpp"
#include "output_file.hpp"
#include "recorded_scene.hpp"
#include "start.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {

struct view_options {
  reading in;
  std::string out, title;
  std::vector<std::string> recordings, columns;
  start_options start;
  double mesh_size = 4, recording_size = 8;  ///< MiB
  bool open = false;
};

std::size_t bytes_of(const char* name, double mib) {
  if (!(mib >= 0 && mib <= 1024))
    throw usage_error(std::string(name) + " is between 0 and 1024, not " + short_number(mib));
  return static_cast<std::size_t>(mib * 1048576);
}

constexpr std::uintmax_t largest_recording = std::uintmax_t{1} << 30;

kte::table read_recording(const std::string& path) {
  std::error_code none;
  if (const auto size = std::filesystem::file_size(path, none); !none && size > largest_recording)
    throw kte::bad_file("kte: " + path + ": the recording has " + std::to_string(size >> 20) +
                        " MiB, above 1024 MiB: record fewer rows or columns");
  return kte::read_table(path);
}
/// Keeps one row in several, and the last, of a table that has more than a page of a size can hold; returns a
/// note, or nothing.
std::string thin(kte::table& numbers, const std::string& name, std::size_t bytes) {
  const std::size_t rows = numbers.rows(), of_row = (8 + 4 * numbers.names.size()) * 4 / 3;
  const std::size_t most = std::max(bytes / of_row, std::size_t{2}), step = (rows + most - 1) / most;
  if (step < 2) return {};
  for (auto& column : numbers.columns) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows; i += step) column[kept++] = column[i];
    if ((rows - 1) % step != 0) column[kept++] = column[rows - 1];
    column.resize(kept), column.shrink_to_fit();
  }
  return "of the " + std::to_string(rows) + " rows of '" + name + "' one in " + std::to_string(step) +
         " is read: a larger --recording-size holds more";
}

int view(view_options& o) {
  const kte::page_options page{.title = o.title,
                               .mesh_bytes = bytes_of("--mesh-size", o.mesh_size),
                               .recording_bytes = bytes_of("--recording-size", o.recording_size)};
  if (o.start.given() && !o.recordings.empty())
    throw usage_error("--start and --configuration are for pages without a recording");
  if (!o.columns.empty() && o.recordings.empty()) throw usage_error("--column is for pages with a recording");
  if (o.out.empty()) o.out = std::filesystem::path(o.in.file).stem().string() + ".html";
  std::vector<named_file> inputs{{"FILE", o.in.file}, {"--start", o.start.table}};
  for (const auto& path : o.recordings) inputs.push_back({"RECORDINGS", path});
  refuse_input_as_output({"-o", o.out}, inputs);
  const auto m = read_and_warn(o.in);
  refuse_file_of_robot_as_output({"-o", o.out}, m, o.in);
  std::vector<kte::scene> all;
  for (const auto& path : o.recordings) {
    auto table = read_recording(path);
    const auto name = std::filesystem::path(path).filename().string();
    const auto thinned = thin(table, name, page.recording_bytes);
    try {
      all.push_back(scene_of(m, std::move(table), name, o.columns));
      if (!thinned.empty()) say(thinned), all.back().notes.push_back(thinned);
    } catch (const kte::unknown_name& e) {
      throw kte::bad_file("kte: " + path + ": " + std::string(e.what()).substr(5));
    }
  }
  const auto drawn = all.empty() ? scene_of(m, o.start) : kte::joined(all);
  for (const auto& note : kte::not_drawn(drawn)) say(o.in.file + ": " + note);
  kte::write_page(o.out, drawn, page);
  say("wrote " + o.out);
  if (o.open) open_in_browser(o.out);
  return 0;
}

}  // namespace

void add_view(command_line& line) {
  const auto o = std::make_shared<view_options>();
  auto& c = add_reading(line.add("view", "writes a page that shows its motion",
                                 "Writes one HTML file that shows the mechanism in a browser, without network access: "
                                 "with sliders, or with the motion of recordings; several recordings are overlaid."),
                        o->in);
  add_start(c, o->start)
      .words("RECORDINGS", o->recordings,
             "tables over time, as written by kte simulate --record: .csv, .npy, .mcap, ...")
      .texts("--column", "NAME", o->columns,
             "plots this column at first: of the recordings, or computed, such as tool/position; repeatable")
      .text("-o,--output", "FILE", o->out, "the page; default: the name of FILE with .html")
      .text("--title", "TEXT", o->title, "title of the page")
      .number("--mesh-size", "MIB", o->mesh_size,
              "limit for all meshes in the page, default 4; larger meshes get fewer triangles")
      .number("--recording-size", "MIB", o->recording_size,
              "limit for all recordings in the page, default 8; longer ones are thinned out")
      .flag("--open", o->open, "opens the page in the browser with xdg-open")
      .runs([o] { return view(*o); });
}

}  // namespace kte_tool
