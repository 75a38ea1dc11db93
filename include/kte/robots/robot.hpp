#pragma once

#include <kte/models/joint_limits.hpp>
#include <kte/robots/description.hpp>
#include <kte/robots/options.hpp>

namespace kte {

/// A robot read from a file (`load_robot`): a chain and further data.
///   name            of the robot
///   chain           frames are named as the links, coordinates as the joints
///   limits          over v, from the file; infinite where it has none
///   soft_limits     limits with the narrower range of safety controllers, where the file has it
///   joints          the coordinates of joints that move, in the order of the file, including followers
///   loops           names of the closures of loops, in the order of the file
///   contacts        names of the rigid contacts of shapes with the ground (`robot_options::contacts`)
///   shapes          visual and collision shapes
///   configurations  named configurations
struct robot {
  /// A shape in the `frame` of its link; `collision`: for collision, not visual.
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
  /// A named configuration of the whole robot.
  struct configuration {
    std::string name;
    std::vector<double> q;  ///< in the order of the q of the chain
  };
  std::string name;
  runtime_chain chain;
  joint_limits<> limits, soft_limits;
  std::vector<std::string> joints;
  std::vector<std::string> loops;
  std::vector<std::string> contacts;
  std::vector<shape> shapes;
  std::vector<robot_actuator> actuators;  ///< actuators in the file
  std::vector<motor> motors;              ///< motors in the chain (`add_motors`)
  std::vector<configuration> configurations;
  std::vector<robot_note> not_read;      ///< contents of the file that are not in the chain, with their lines
  std::vector<robot_note> warnings;      ///< differences in motion from the robot of the file, then probable mistakes
  std::string file;                      ///< name of the file in messages; meshes are searched for around it
  std::vector<std::string> search_path;  ///< further folders: robot_options::search_path
};

}  // namespace kte
