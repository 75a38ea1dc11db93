#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kte {

/// How a live page is served: `kte::live_page page(arm, {.title = "Our arm"})`.
struct live_options {
  std::string title{};  ///< if empty, the name of the robot
  int port = 0;         ///< 0: one that is free
  /// Quantities to plot and to record besides q and v of coordinates, by the names that `kte::recorder` has for them.
  std::vector<std::string> columns{};
  bool paused = false;  ///< at the start
  double speed = 1;     ///< seconds of the simulation in a second, at the start
  /// Of recordings in memory. A recording that is full ends, which the page says.
  std::size_t recording_bytes = std::size_t{64} << 20;
  /// Of the meshes in the page, as text (`page_options::mesh_bytes`).
  std::size_t mesh_bytes = std::size_t{4} << 20;
};

}  // namespace kte
