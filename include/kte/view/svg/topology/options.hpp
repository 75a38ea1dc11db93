#pragma once

#include <string>

namespace kte {

/// Options of a topology: `kte::write_topology("arm.svg", scene, {.width = 170})`.
struct topology_options {
  double width = 0;      ///< mm, to which the picture is scaled, with its letters; 0: the natural size of the letters
  double font_size = 8;  ///< points of 1/72 inch
  std::string font = "sans-serif";
  std::string title{};  ///< for screen readers; empty for that of the scene
};

}  // namespace kte
