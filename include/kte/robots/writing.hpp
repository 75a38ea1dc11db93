#pragma once

#include <kte/robots/description.hpp>

#include <functional>

namespace kte {

/// Options of writing a robot into a file (`to_urdf`, `to_mjcf`).
struct robot_writing {
  /// Receives notes on the contents of the robot that are not in the file as they are in the robot, with lines of the
  /// file that the robot is from. The notes are also comments at the top of the text.
  std::vector<robot_note>* not_written = nullptr;
  /// Whether contents that the format does not support and that change the motion are approximated or omitted, and
  /// listed; otherwise they are rejected.
  bool lossy = false;
  /// MJCF: whether limits of efforts are written (actuatorfrcrange, MuJoCo 2.3.7 or later); otherwise they are listed.
  bool effort_limits = false;
  /// Returns the path to write for the mesh of a shape; for an empty path the shape is omitted, and listed. Without it
  /// URDF has the paths unchanged, and MJCF absolute paths of the files that exist; other meshes are omitted.
  std::function<std::string(const std::string& mesh)> mesh_path{};
};

}  // namespace kte
