#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace kte {

/// Options of a live page: `kte::live_page page(arm, {.title = "Our arm"})`.
struct live_options {
  std::string title{};  ///< if empty, the name of the robot
  int port = 0;         ///< 0: any free port
  /// Quantities to plot and to record in addition to q and v of coordinates, by their names in `kte::recorder`.
  std::vector<std::string> columns{};
  bool paused = false;  ///< whether the page starts paused
  double speed = 1;     ///< initial speed, seconds of the simulation per second
  /// Largest size of recordings in memory. A full recording ends, and the page reports it.
  std::size_t recording_bytes = std::size_t{64} << 20;
  /// Largest size of the meshes in the page, as text (`page_options::mesh_bytes`).
  std::size_t mesh_bytes = std::size_t{4} << 20;
};

}  // namespace kte
