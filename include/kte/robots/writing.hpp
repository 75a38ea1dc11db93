#pragma once

#include <kte/robots/description.hpp>

#include <functional>

namespace kte {

/// How a robot is written into a file (`to_urdf`, `to_mjcf`).
struct robot_writing {
  /// Where what is not in the file as it is in the robot is listed, with lines of the file that the robot is from. The
  /// entries are also comments at the head of the text.
  std::vector<robot_note>* not_written = nullptr;
  /// Whether what the format cannot say and changes the motion is written as near as may be, or left out, and listed;
  /// else it is refused.
  bool lossy = false;
  /// MJCF: whether limits of efforts are written (actuatorfrcrange: MuJoCo reads it from 2.3.7 on), else listed.
  bool effort_limits = false;
  /// The path that is written for the mesh of a shape; of an empty one the shape is left out, and listed. If it is not
  /// set, paths are written as they are.
  std::function<std::string(const std::string& mesh)> mesh_path{};
};

}  // namespace kte
