#include <kte/io/table_reader.hpp>
#include <kte/view/write_page.hpp>

#include "browser.hpp"
#include "commands.hpp"
#include "message.hpp"
#include "recorded_scene.hpp"

namespace kte_tool {

namespace {

struct view_options {
  reading in;
  std::string out, title;
  std::vector<std::string> recordings;
  bool open = false;
};

int view(view_options& o) {
  const auto m = read_and_warn(o.in);
  if (o.out.empty()) o.out = std::filesystem::path(o.in.file).stem().string() + ".html";
  kte::page_options page;
  page.title = o.title;
  std::vector<kte::scene> all;
  for (const auto& path : o.recordings)
    all.push_back(scene_of(m, kte::read_table(path), std::filesystem::path(path).filename().string()));
  kte::write_page(o.out, all.empty() ? scene_of(m) : kte::joined(all), page);
  say("wrote " + o.out);
  if (o.open) open_in_browser(o.out);
  return 0;
}

}  // namespace

void add_view(command_line& line) {
  const auto o = std::make_shared<view_options>();
  add_reading(line.add("view", "a page that shows it, moving",
                       "Writes one HTML file, without any network access, that shows the mechanism in a browser: with "
                       "sliders, or moving as recordings say, several over each other."),
              o->in)
      .words("RECORDINGS", o->recordings,
             "tables over time, as kte simulate --record writes them: .csv, .npy, .mcap, ...")
      .text("-o,--output", "FILE", o->out, "the page; if left out the name of FILE, with .html")
      .text("--title", "TEXT", o->title, "of the page")
      .flag("--open", o->open, "opens it in the browser, by xdg-open")
      .runs([o] { return view(*o); });
}

}  // namespace kte_tool
