#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kte {

/// Options of a page: `kte::write_page("arm.html", arm, {.title = "Our arm"})`.
struct page_options {
  std::string title{};  ///< if empty, the name of the robot or of the file
  /// Largest size of all meshes in a page, as text. Larger meshes are simplified, the largest first.
  std::size_t mesh_bytes = std::size_t{4} << 20;
  /// Largest size of all recordings in a page, as text. Longer recordings keep every second row, third row, ...
  std::size_t recording_bytes = std::size_t{8} << 20;
};

/// Options of a recording for a picture.
struct recording_options {
  std::string name{};  ///< its label
  /// Quantities to plot in addition to the coordinates, by their names in `kte::recorder`.
  std::vector<std::string> columns{};
};

}  // namespace kte
