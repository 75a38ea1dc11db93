#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kte {

/// How a page is written: `kte::write_page("arm.html", arm, {.title = "Our arm"})`.
struct page_options {
  std::string title{};  ///< if empty, the name of the robot or of the file
  /// Of the meshes in a page together, as text. Those that take more are made of fewer triangles, the largest first.
  std::size_t mesh_bytes = std::size_t{4} << 20;
  /// Of the recordings in a page together, as text. Longer ones are thinned out: every second row, third row, ...
  std::size_t recording_bytes = std::size_t{8} << 20;
};

/// What a recording for a picture has besides poses.
struct recording_options {
  std::string name{};  ///< shown beside others
  /// Quantities to plot, by the names that `kte::recorder` has for them. The coordinates are plotted anyway.
  std::vector<std::string> columns{};
};

}  // namespace kte
