#pragma once

#include <kte/view/scene_of.hpp>
#include <kte/view/svg/moving_picture.hpp>
#include <kte/view/svg/picture.hpp>
#include <kte/view/svg/plot.hpp>
#include <kte/view/svg/topology.hpp>

/// Pictures for papers in SVG, of chains, robots and recordings (docs/pictures.md). Needs the library kte::view, which
/// makes scenes. For a `scene`, and for plots of tables, kte/view/svg/picture.hpp and kte/view/svg/plot.hpp are
/// sufficient.
namespace kte {

/// Units of the coordinates and columns of a mechanism, by name: `kte::plot(run, {"elbow"}, {.units =
/// units_of(scene)})`.
[[nodiscard]] inline unit_map units_of(const scene& s) {
  unit_map units;
  for (const auto& r : s.recordings)
    for (const auto& c : r.columns)
      if (!c.unit.empty()) units[c.name] = c.unit;
  for (const auto& c : s.coordinates)
    if (c.kind == "angle" || c.kind == "length") units[c.name] = c.unit;
  return units;
}
template <drawable Chain>
[[nodiscard]] unit_map units_of(const Chain& chain) {
  return units_of(scene_of(chain));
}

/// Draws a mechanism as SVG to a file: a recording, a chain with all coordinates zero, or a chain moved by the rows of
/// a table.
inline void write_picture(const std::filesystem::path& file, const recorded_scene& r, const picture_options& o = {}) {
  write_picture(file, r.contents(), o);
}
template <drawable Chain>
void write_picture(const std::filesystem::path& file, const Chain& chain, const picture_options& o = {}) {
  write_picture(file, scene_of(chain), o);
}
template <drawable Chain>
void write_picture(const std::filesystem::path& file, const Chain& chain, const table& numbers,
                   const picture_options& o = {}) {
  write_picture(file, scene_of(chain, numbers), o);
}
/// Draws a recording, or a chain moved by the rows of a table, as an animated SVG to a file.
inline void write_moving_picture(const std::filesystem::path& file, const recorded_scene& r,
                                 const picture_options& o = {}) {
  write_moving_picture(file, r.contents(), o);
}
template <drawable Chain>
void write_moving_picture(const std::filesystem::path& file, const Chain& chain, const table& numbers,
                          const picture_options& o = {}) {
  write_moving_picture(file, scene_of(chain, numbers), o);
}
/// Draws the topology of a chain as SVG to a file.
template <drawable Chain>
void write_topology(const std::filesystem::path& file, const Chain& chain, const topology_options& o = {}) {
  write_topology(file, scene_of(chain), o);
}

}  // namespace kte
