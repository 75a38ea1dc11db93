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
  std::vector<std::string> recordings;
  start_options start;
  double mesh_size = 4, recording_size = 8;  ///< MiB
  bool open = false;
};

std::size_t bytes_of(const char* name, double mib) {
  if (!(mib >= 0 && mib <= 1024))
    throw usage_error(std::string(name) + " is between 0 and 1024, not " + short_number(mib));
  return static_cast<std::size_t>(mib * 1048576);
}

int view(view_options& o) {
  const kte::page_options page{.title = o.title,
                               .mesh_bytes = bytes_of("--mesh-size", o.mesh_size),
                               .recording_bytes = bytes_of("--recording-size", o.recording_size)};
  if (o.start.given() && !o.recordings.empty())
    throw usage_error("--start and --configuration are for pages without a recording");
  if (o.out.empty()) o.out = std::filesystem::path(o.in.file).stem().string() + ".html";
  std::vector<named_file> inputs{{"FILE", o.in.file}, {"--start", o.start.table}};
  for (const auto& path : o.recordings) inputs.push_back({"RECORDINGS", path});
  refuse_input_as_output({"-o", o.out}, inputs);
  const auto m = read_and_warn(o.in);
  std::vector<kte::scene> all;
  for (const auto& path : o.recordings) {
    auto table = kte::read_table(path);
    try {
      all.push_back(scene_of(m, std::move(table), std::filesystem::path(path).filename().string()));
    } catch (const kte::unknown_name& e) {
      throw kte::bad_file("kte: " + path + ": " + std::string(e.what()).substr(5));
    }
  }
  kte::write_page(o.out, all.empty() ? scene_of(m, o.start) : kte::joined(all), page);
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
