#include <kte/io/replace_file.hpp>
#include <kte/view/write_page.hpp>

#include "page_text.hpp"

namespace kte {

namespace {
/// Whether the recordings of two scenes are of the same frames and coordinates.
bool same_tracks(const scene& a, const scene& b) {
  const auto same_frame = [](const scene::frame& x, const scene::frame& y) {
    return x.name == y.name && x.track == y.track && x.parent == y.parent;
  };
  const auto same_coordinate = [](const scene::coordinate& x, const scene::coordinate& y) {
    return x.name == y.name && x.q == y.q && x.size == y.size;
  };
  return a.tracks == b.tracks &&
         std::equal(a.frames.begin(), a.frames.end(), b.frames.begin(), b.frames.end(), same_frame) &&
         std::equal(a.coordinates.begin(), a.coordinates.end(), b.coordinates.begin(), b.coordinates.end(),
                    same_coordinate);
}
}  // namespace

scene joined(const std::vector<scene>& all) {
  if (all.empty()) detail::raise<bad_argument>("kte: a page needs a recording");
  scene out = all.front();
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (!same_tracks(out, all[i]))
      detail::raise<bad_argument>("kte: all recordings of a page must be of one mechanism, but recording " +
                                  std::to_string(i + 1) + " has other frames or coordinates than the first");
    out.recordings.insert(out.recordings.end(), all[i].recordings.begin(), all[i].recordings.end());
    for (const auto& n : all[i].notes)
      if (std::find(out.notes.begin(), out.notes.end(), n) == out.notes.end()) out.notes.push_back(n);
  }
  return out;
}

void write_page(const std::filesystem::path& path, const scene& s, const page_options& options) {
  detail::replace_file(path, view::page_text(s, options, path.stem().string()));
}

void write_page(const std::filesystem::path& path,
                std::initializer_list<std::reference_wrapper<const recorded_scene>> recordings,
                const page_options& options) {
  std::vector<scene> all;
  for (const recorded_scene& r : recordings) all.push_back(r.contents());
  write_page(path, joined(all), options);
}

}  // namespace kte
