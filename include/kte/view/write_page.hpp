#pragma once

#include <kte/view/scene_of.hpp>

#include <filesystem>
#include <functional>
#include <initializer_list>

/// A mechanism as one HTML file that shows it moving, without any network (docs/view.md). Needs the library kte::view.
namespace kte {

/// Writes a page of a scene. The file is replaced after all is written. Throws `bad_file` if it cannot be written,
/// `bad_argument` for a scene whose parts do not fit together.
void write_page(const std::filesystem::path& path, const scene& s, const page_options& options = {});

/// Writes a page of a recording.
inline void write_page(const std::filesystem::path& path, const recorded_scene& r, const page_options& options = {}) {
  write_page(path, r.contents(), options);
}
/// Writes a page of several recordings of one mechanism, drawn over each other. Throws `bad_argument` if their frames
/// differ.
void write_page(const std::filesystem::path& path,
                std::initializer_list<std::reference_wrapper<const recorded_scene>> recordings,
                const page_options& options = {});

/// Writes a page of the mechanism with all coordinates zero, with sliders.
template <drawable Chain>
void write_page(const std::filesystem::path& path, const Chain& chain, const page_options& options = {}) {
  write_page(path, scene_of(chain), options);
}
/// Writes a page of the mechanism that moves as a table (`scene_of`).
template <drawable Chain>
void write_page(const std::filesystem::path& path, const Chain& chain, const table& numbers,
                const page_options& options = {}) {
  write_page(path, scene_of(chain, numbers), options);
}
/// Writes a page of a recording: `write_page("swing.html", pendulum, rec)`.
template <drawable Chain>
void write_page(const std::filesystem::path& path, const Chain&, const scene_recording<Chain>& r,
                const page_options& options = {}) {
  write_page(path, r.contents(), options);
}

/// A recording: a table of `numbers`, with its name in the page.
struct named_table {
  std::string name;
  table numbers;
};
/// The scene with all recordings of several scenes of one mechanism. Throws `bad_argument` if their frames differ.
[[nodiscard]] scene joined(const std::vector<scene>& all);

template <drawable Chain>
void write_page(const std::filesystem::path& path, const Chain& chain, const std::vector<named_table>& tables,
                const page_options& options = {}) {
  std::vector<scene> all;
  for (const auto& t : tables) all.push_back(scene_of(chain, t.numbers, {.name = t.name}));
  write_page(path, joined(all), options);
}

}  // namespace kte
