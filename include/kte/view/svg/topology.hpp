#pragma once

#include <kte/io/replace_file.hpp>
#include <kte/view/svg/topology/drawing.hpp>

namespace kte {

/// The topology of a mechanism: rigid bodies as boxes, in layers from the ground; joints between them as letters (R
/// revolute, P prismatic, H screw, C cylindrical, U universal, S spherical, E planar, F free) with their names; loops,
/// and forces between two bodies, as dashed arcs. Returns SVG 1.1 as text.
///
/// Throws `bad_argument` for invalid sizes, and scenes whose parts do not fit together.
[[nodiscard]] inline std::string topology_picture(const scene& s, const topology_options& o = {}) {
  const detail::svg::rigid_groups groups(s);
  return detail::svg::topology_drawing(s, groups, o).text();
}

/// Writes a topology to a file, which is replaced after all is written. Throws `bad_file` if it cannot be written.
inline void write_topology(const std::filesystem::path& file, const scene& s, const topology_options& o = {}) {
  detail::replace_file(file, topology_picture(s, o));
}

}  // namespace kte
