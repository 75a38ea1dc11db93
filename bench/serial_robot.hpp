#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

/// Robots as lists of numbers: what peers are built from, and the textbook's algorithms work on.
namespace bench {

/// A revolute joint and the body behind it: where the joint is placed in the frame of the body before, about which axis
/// it turns, and in the axes of the body its mass, centre of mass and inertia about that. m, kg, kg m^2.
struct serial_link {
  Eigen::Matrix3d rotation;  ///< of the placement
  Eigen::Vector3d position;  ///< of the placement
  Eigen::Vector3d axis;
  double mass;
  Eigen::Vector3d com;
  Eigen::Matrix3d inertia;
};

struct serial_robot {
  std::vector<serial_link> links;
  Eigen::Vector3d gravity;        ///< m/s^2
  Eigen::Matrix3d tool_rotation;  ///< in the last body
  Eigen::Vector3d tool_position;
};

/// "pendulum", "iiwa14", "ur5" or "serial" with a number, such as "serial8", whose tool is its last body.
serial_robot robot_of(const std::string& model);

/// 12 of "serial12", 0 of other models.
int serial_length(const std::string& model);

}  // namespace bench
