#include <kte/io/mcap_table.hpp>
#include <kte/io/replace_file.hpp>
#include <kte/view/write_mcap.hpp>

#include <algorithm>

#include "foxglove.hpp"
#include "scene_checks.hpp"

namespace kte {

namespace {
/// The names that a recorder has for the numbers of a coordinate.
std::vector<std::string> names_of(const scene::coordinate& c) {
  if (c.size == 1) return {c.name};
  std::vector<std::string> all;
  const auto add = [&](const std::string& of, std::string_view components) {
    for (const char x : components) all.push_back(c.name + "/" + of + "/" + x);
  };
  if (c.kind != "rotation") add("position", c.kind == "pose_2D" ? "xy" : "xyz");
  if (c.kind == "pose_2D")
    all.push_back(c.name + "/angle");
  else
    add("rotation", "wxyz");
  return all;
}

/// t, the coordinates, and the columns that are no coordinates.
struct numbers_table {
  std::vector<std::string> names{"t"};
  std::vector<const scene::column*> columns;

  explicit numbers_table(const scene& s) {
    const auto& r = s.recordings.front();
    for (const auto& c : s.coordinates)
      if (c.q >= 0 && !r.q.empty())
        for (auto& n : names_of(c)) names.push_back(std::move(n));
    for (const auto& c : r.columns) {
      if (std::find(names.begin(), names.end(), c.name) != names.end()) continue;
      names.push_back(c.name), columns.push_back(&c);
    }
    detail::check_column_names(names);
  }
};
}  // namespace

void write_mcap(const std::filesystem::path& path, const scene& s) {
  view::check(s);
  if (s.recordings.size() != 1)
    detail::raise<bad_argument>("kte: a file of MCAP has one recording, and the scene has " +
                                std::to_string(s.recordings.size()));
  const auto& r = s.recordings.front();
  const numbers_table numbers(s);
  const view::foxglove_messages messages(s);
  detail::mcap_table table;
  std::string out;
  table.head(numbers.names, out);
  enum : std::uint16_t { transforms = 2, transforms_at_rest, solids, lines };  // channels; 1 is the table
  detail::append_mcap_schema(out, 2, "foxglove.FrameTransforms", view::frame_transforms_schema);
  detail::append_mcap_schema(out, 3, "foxglove.SceneUpdate", view::scene_update_schema);
  detail::append_mcap_channel(out, transforms, 2, "/tf");
  detail::append_mcap_channel(out, transforms_at_rest, 2, "/tf_static");
  detail::append_mcap_channel(out, solids, 3, "/scene");
  detail::append_mcap_channel(out, lines, 3, "/scene/lines");
  const auto message = [&](std::uint16_t channel, std::size_t row, const std::string& text) {
    detail::append_mcap_message(out, channel, static_cast<std::uint32_t>(row), detail::mcap_time(r.t[row]),
                                [&] { out += text; });
  };
  message(transforms_at_rest, 0, messages.transforms(0, false));
  message(solids, 0, messages.solids());
  std::vector<double> line(numbers.names.size());
  const std::size_t nq = r.q.empty() ? 0 : s.q.size();
  for (std::size_t i = 0; i < r.t.size(); ++i) {
    line[0] = r.t[i];
    std::copy_n(r.q.data() + i * nq, nq, line.begin() + 1);
    for (std::size_t k = 0; k < numbers.columns.size(); ++k) line[1 + nq + k] = numbers.columns[k]->data[i];
    table.row(line, out);
    message(transforms, i, messages.transforms(i, true));
    message(lines, i, messages.lines(i));
  }
  table.tail(out);
  detail::replace_file(path, out);
}

}  // namespace kte
