#pragma once

#include <Eigen/Core>

#include "mechanism.hpp"

namespace kte_tool {

/// A mechanism as people look at it, at a configuration, the neutral one by default: frames in a tree, bodies,
/// coordinates.
struct structure {
  struct frame {
    std::string name;
    bool planar = false;
    int parent = -1;                    ///< of the list; -1: a base
    std::string by;                     ///< the type of the joint or link from the parent; empty: a base
    std::vector<std::string> moved_by;  ///< coordinates of that joint
    kte::vec3<> axis{};                 ///< of a joint that has one
    bool has_axis = false;
    kte::vec3<> position{};  ///< at the configuration, in the world
    kte::mat3<kte::vec3<>> rotation{};
  };
  struct body {
    std::string frame;
    double mass = 0;
    kte::vec3<> centre{};             ///< in axes of the frame
    kte::sym3<> inertia{};            ///< about the centre, in axes of the frame
    std::array<double, 3> moments{};  ///< principal ones, ascending
    bool as_published = false;
  };
  struct coordinate {
    std::string name, kind, unit;        ///< the unit is of q; empty where it has several numbers
    std::vector<std::string> moves;      ///< types of joints
    int q = -1, nq = 0, v = -1, nv = 0;  ///< -1: it follows others
    bool turns = false;                  ///< whether it is an angle
  };
  struct other {
    std::string type, text;
  };
  std::vector<frame> frames;
  std::vector<body> bodies;
  std::vector<coordinate> coordinates;
  std::vector<other> others;  ///< elements that are neither joints nor links nor bodies
  std::vector<std::string> inputs;
  double mass = 0;  ///< kg
  /// The diagonal of the box that holds all frames, centres of mass, and shapes that move, or all shapes if none moves,
  /// m. Shapes of meshes, planes and height fields do not count.
  double size = 0;

  explicit structure(const kte::robot& r);
  structure(const kte::robot& r, const Eigen::VectorXd& q);
};

/// "revolute" of "revolute_joint_3D".
std::string short_type(const std::string& type);

}  // namespace kte_tool
