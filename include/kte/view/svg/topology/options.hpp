#pragma once

#include <string>

namespace kte {

/// How the topology of a mechanism is drawn: `kte::write_topology("arm.svg", scene, {.width = 170})`.
struct topology_options {
  double width = 0;  ///< mm, to which all of it, letters too, is made larger or smaller; 0: as large as letters want
  double font_size = 8;  ///< points of 1/72 inch
  std::string font = "sans-serif";
  std::string title{};  ///< what screen readers call it; empty for that of the scene
};

}  // namespace kte
