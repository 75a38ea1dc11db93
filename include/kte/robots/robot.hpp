#pragma once

#include <kte/models/joint_limits.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/options.hpp>

namespace kte {

/// A robot read from a file (`load_robot`): a chain, and what a chain has no place for.
///   chain        frames are named as the links, coordinates as the joints
///   limits       over v, from the file; infinite where it says nothing
///   soft_limits  the same, with the narrower range of safety controllers where there is one
///   joints       the coordinates of joints that move, in the file's order, with those that follow others
struct robot {
  struct shape : robot_shape {
    std::string frame;
    bool collision = false;
    std::string file{};  ///< the included file that it is in; empty for the robot's own
  };
  /// A motor of the chain: its command is the input u of this name, in the order of the list; `v` is the place of its
  /// joint in v.
  struct motor {
    std::string input, joint;
    int v = 0;
  };
  /// A configuration of the whole robot, by name.
  struct configuration {
    std::string name;
    std::vector<double> q;  ///< in the order of the chain
  };
  std::string name;
  runtime_chain chain;
  joint_limits<> limits, soft_limits;
  std::vector<std::string> joints;
  std::vector<shape> shapes;
  std::vector<robot_actuator> actuators;  ///< as the file has them
  std::vector<motor> motors;              ///< those in the chain (`add_motors`)
  std::vector<configuration> configurations;
  std::vector<robot_note> not_read;      ///< what the file holds and the chain does not, with lines
  std::vector<robot_note> warnings;      ///< first what moves differently from the file's robot, then what is odd
  std::string file;                      ///< what messages call the file; meshes are looked for around it
  std::vector<std::string> search_path;  ///< where else: robot_options::search_path
};

}  // namespace kte
