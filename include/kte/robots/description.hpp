#pragma once

#include <kte/elements/joint_motor.hpp>
#include <kte/math/rigid_body.hpp>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// A robot as files describe it, whatever their format: links, and joints between them, as data. m, kg, s, rad.
namespace kte {

/// Something that was seen in a file at a line, from 1; 0 is nowhere.
struct robot_note {
  int line = 0;
  std::string text;
  std::string file{};           ///< the included file that it is in; empty for the robot's own
  bool changes_motion = false;  ///< the robot of the file moves differently from the one that was read
};

/// Where something stands: position and rotation in the axes of what it belongs to.
struct robot_pose {
  vec3<> position{};
  mat3<vec3<>> rotation{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  bool operator==(const robot_pose&) const = default;
};

/// A shape to see, or one to collide with.
struct robot_shape {
  enum class form { none, box, cylinder, capsule, sphere, ellipsoid, plane, mesh };
  std::string name;
  robot_pose origin;  ///< in the link
  form is = form::none;
  vec3<> size{};          ///< box: edges; cylinder, capsule: radius, length; sphere: radius; ellipsoid: half axes
  std::string mesh;       ///< name of the file, as written; of MJCF with the folders that it is in
  vec3<> scale{1, 1, 1};  ///< of the mesh
  std::string material;
  std::vector<double> rgba;  ///< four numbers, or none
  int line = 0;
};

/// A link: a body, a frame of its name, and shapes.
struct robot_link {
  std::string name;
  int line = 0;
  std::string file{};                    ///< as of notes
  std::optional<rigid_body<>> inertial;  ///< in the axes of the link; massless without
  double gravity_compensation = 0;       ///< of its weight, this part is borne by a force at the centre of mass
  std::vector<robot_shape> visuals, collisions;
};

/// A frame that stands still in a link: a site of MJCF, a frame of SDF.
struct robot_frame {
  std::string name;
  int line = 0;
  std::string link;
  robot_pose origin;  ///< in the link
};

/// What a joint does besides moving.
struct robot_joint_dynamics {
  double damping = 0;    ///< Nms/rad or Ns/m
  double friction = 0;   ///< dry, Nm or N
  double stiffness = 0;  ///< of a spring, Nm/rad or N/m
  double rest = 0;       ///< where that spring is at rest
  double armature = 0;   ///< inertia of the rotor as the joint feels it, kg m^2 or kg
  /// A time constant T, s, and a damping ratio z, instead of `damping` and `stiffness`, which are then d = 2 I/T and
  /// k = I/(T z)^2. 1/I is the joint's entry on the diagonal of M^-1 where the robot stands as written. 0: not given.
  double time_constant = 0, damping_ratio = 0;
  bool operator==(const robot_joint_dynamics&) const = default;
};

/// A joint between two links. Its placement stands in the parent; the child link stands in what it moves.
struct robot_joint {
  enum class kind { fixed, revolute, prismatic, spherical, planar, floating, screw };
  static constexpr double none = std::numeric_limits<double>::infinity();

  std::string name;
  int line = 0;
  std::string file{};  ///< as of notes
  kind is = kind::fixed;
  bool continuous = false;  ///< a revolute joint without limits, as the file says
  std::string parent, child;
  robot_pose origin;      ///< of the placement in the parent
  robot_pose child_pose;  ///< of the child in the moving side of the joint
  vec3<> axis{1, 0, 0};   ///< of length 1, in the axes of the placement; of a planar joint the normal
  double pitch = 0;       ///< of a screw, m/rad: its coordinate is the angle
  double lower = -none, upper = none, rate = none, effort = none;
  double soft_lower = -none, soft_upper = none;  ///< where a safety controller begins to brake
  robot_joint_dynamics dynamics;
  struct follower {
    std::string joint;
    double ratio = 1, offset = 0;
  };
  std::optional<follower> mimic;  ///< q = ratio q_joint + offset
  double reference = 0;           ///< the coordinate where the robot stands as the file writes it
};

/// Whether a joint moves by one number.
inline bool has_one_coordinate(const robot_joint& j) {
  using enum robot_joint::kind;
  return j.is == revolute || j.is == prismatic || j.is == screw;
}

/// What drives a joint: the gear n from one to the other, and the law of the actuator, before the gear. With f its
/// force, n f is that of the joint, and its position and rate are n times those of the joint.
struct robot_actuator {
  std::string name;
  int line = 0;
  std::string joint;
  double gear = 1;
  motor_law law{};             ///< of URDF with the gain 1/n: its commands are forces of joints
  std::string not_modelled{};  ///< what of its law is not modelled, as "muscle"; else empty
};

/// A configuration that has a name, as a keyframe of MJCF: the numbers of q of joints, by their names.
struct robot_configuration {
  std::string name;
  int line = 0;
  std::vector<std::pair<std::string, std::vector<double>>> joints;
};

struct robot_description {
  std::string name;
  std::string source;  ///< what messages call the file
  std::vector<robot_link> links;
  std::vector<robot_joint> joints;
  std::vector<robot_frame> frames;
  std::vector<robot_actuator> actuators;
  std::vector<robot_configuration> configurations;
  std::optional<vec3<>> gravity;     ///< if the file says so, m/s^2
  std::vector<robot_note> not_read;  ///< what the file holds and nothing here does
  std::vector<robot_note> warnings;  ///< what was read, but is odd
};

namespace detail {
/// "arm.urdf:37: ", or what of it is known.
inline std::string place_text(const std::string& source, int line) {
  if (source.empty()) return line > 0 ? "line " + std::to_string(line) + ": " : "";
  return source + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
}
}  // namespace detail

}  // namespace kte
