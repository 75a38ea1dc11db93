#include <kte/io/table_reader.hpp>
#include <kte/view.hpp>

#include "browser.hpp"
#include "commands.hpp"
#include "message.hpp"
#include "state_input.hpp"

namespace kte_tool {

namespace {

struct options {
  reading in;
  std::string out, title;
  std::vector<std::string> recordings;
  bool open = false;
};

/// A recording under the names that the library has for its columns: those of `kte simulate` have no blanks, and those
/// of other programs may be q_0, q_1, ...
kte::table read_recording(const std::string& path, const mechanism& m) {
  auto t = kte::read_table(path);
  const auto& c = m.chain();
  const recorded_state recorded(c);
  const evaluate::column_order order(kte::layout(c), coordinates_of(m, c));
  for (auto& name : t.names)
    for (const auto& x : recorded.columns()) {
      const auto numbered = [&](const char* prefix, const std::vector<int>& places, recorded_column::part part) {
        for (std::size_t i = 0; i < places.size(); ++i)
          if (x.is == part && x.index == places[i] && name == prefix + std::to_string(i)) return true;
        return false;
      };
      if (name == x.name || numbered("q_", order.q, recorded_column::part::q) ||
          numbered("v_", order.v, recorded_column::part::v)) {
        name = x.whole;
        break;
      }
    }
  return t;
}

int view(options& o) {
  const auto m = read_and_warn(o.in);
  if (o.out.empty()) o.out = std::filesystem::path(o.in.file).stem().string() + ".html";
  kte::page_options page;
  page.title = o.title;
  if (o.recordings.empty()) {
    kte::write_page(o.out, m.robot, page);
  } else {
    std::vector<kte::named_table> tables;
    for (const auto& path : o.recordings)
      tables.push_back({std::filesystem::path(path).filename().string(), read_recording(path, m)});
    kte::write_page(o.out, m.robot, tables, page);
  }
  say("wrote " + o.out);
  if (o.open) open_in_browser(o.out);
  return 0;
}

}  // namespace

void add_view(command_line& line) {
  const auto o = std::make_shared<options>();
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
