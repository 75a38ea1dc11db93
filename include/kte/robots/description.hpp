#pragma once

#include <kte/elements/joint_motor.hpp>
#include <kte/math/rigid_body.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// A robot as files describe it, whatever their format: links, and joints between them, as data. m, kg, s, rad.
namespace kte {

/// A note about a file: `text`, `line` from 1, or 0 without a place.
struct robot_note {
  int line = 0;
  std::string text;
  std::string file{};           ///< the included file that it is in; empty for the robot's own
  bool changes_motion = false;  ///< whether the robot in the file moves differently from the robot that was read
};

/// A pose in the axes of the parent: `position`, m, and `rotation`.
struct robot_pose {
  vec3<> position{};
  mat3<vec3<>> rotation{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  bool operator==(const robot_pose&) const = default;
};

/// How a collision shape touches others, as its file describes it.
struct robot_touch {
  std::optional<double> friction, restitution;  ///< coefficients, if the file has them
  std::uint32_t type = 1, affinity = 1;         ///< contype and conaffinity of MJCF, bit masks
  int priority = 0;                             ///< of two shapes that touch, that of the higher one is used (MJCF)
  int dimensions = 3;                           ///< condim of MJCF: 1 without friction, above 3 also against turning
  bool operator==(const robot_touch&) const = default;
};

/// A visual or collision shape. `form`: none, box, cylinder, capsule, sphere, ellipsoid, plane, mesh, height_field;
/// `is`: the form of this shape; `name` and `material` as in the file, `line` in the file.
struct robot_shape {
  enum class form { none, box, cylinder, capsule, sphere, ellipsoid, plane, mesh, height_field };
  std::string name;
  robot_pose origin;  ///< in the link
  form is = form::none;
  vec3<> size{};     ///< box: edges; cylinder, capsule: radius, length; sphere: radius; ellipsoid, field: half axes
  std::string mesh;  ///< name of the file, as written; for MJCF with its folders
  vec3<> scale{1, 1, 1};  ///< scale of the mesh
  std::string material;
  std::vector<double> rgba;  ///< four numbers, or none
  int line = 0;
  robot_touch touch{};            ///< of a collision shape
  std::vector<double> heights{};  ///< of a height field, m, in rows along x, from the corner of negative x and y
  std::size_t columns = 0;        ///< heights in a row
};

/// A link: a body, a frame of its name, and shapes (`visuals`, `collisions`); `line` in the file.
struct robot_link {
  std::string name;
  int line = 0;
  std::string file{};                    ///< name of the included file; empty for the robot's own
  std::optional<rigid_body<>> inertial;  ///< in the axes of the link; without it the link has no mass
  double gravity_compensation = 0;       ///< fraction of its weight compensated by a force at the centre of mass
  std::vector<robot_shape> visuals, collisions;
};

/// A frame fixed to a `link`: a site of MJCF, a frame of SDF; `name` and `line` as in the file.
struct robot_frame {
  std::string name;
  int line = 0;
  std::string link;
  robot_pose origin;  ///< in the link
};

/// Forces and inertia of a joint.
struct robot_joint_dynamics {
  /// Further coefficients of a polynomial.
  struct powers {
    double quadratic = 0;  ///< N or Nm over the square of a rate or deflection
    double cubic = 0;      ///< N or Nm over its third power
    bool operator==(const powers&) const = default;
  };
  double damping = 0;    ///< Nms/rad or Ns/m
  double friction = 0;   ///< dry friction, Nm or N
  double stiffness = 0;  ///< stiffness of a spring, Nm/rad or N/m
  double rest = 0;       ///< coordinate at which the spring is at rest
  double armature = 0;   ///< reflected inertia of the rotor, kg m^2 or kg
  /// Time constant T, s, and damping ratio z, instead of `damping` and `stiffness`, which are then d = 2 I/T and k =
  /// I/(T z)^2; 1/I is the diagonal entry of the joint in M^-1 at the configuration of the file. 0: not given.
  double time_constant = 0, damping_ratio = 0;
  powers damping_powers{};    ///< of the damper: of |v| v and v^3 at the rate v
  powers stiffness_powers{};  ///< of the spring: of x^2 and x^3 at the deflection x from `rest`
  bool operator==(const robot_joint_dynamics&) const = default;
};

/// A joint between two links, `parent` and `child`. Its placement is fixed in the parent; the child is fixed to the
/// moving side. `kind`: fixed, revolute, prismatic, spherical, planar, floating, screw; `is`: the kind of this joint.
/// `lower`, `upper`: its range, rad or m, `rate`, rad/s or m/s, `effort`, Nm or N; `none` (infinite) where there is no
/// limit. `name` and `line` as in the file, `dynamics`: forces and inertia.
struct robot_joint {
  enum class kind { fixed, revolute, prismatic, spherical, planar, floating, screw };
  static constexpr double none = std::numeric_limits<double>::infinity();

  std::string name;
  int line = 0;
  std::string file{};  ///< name of the included file; empty for the robot's own
  kind is = kind::fixed;
  bool continuous = false;  ///< a revolute joint declared as unlimited in the file
  std::string parent, child;
  robot_pose origin;      ///< pose of the placement in the parent
  robot_pose child_pose;  ///< pose of the child in the moving side of the joint
  vec3<> axis{1, 0, 0};   ///< unit axis in the axes of the placement; for a planar joint the normal
  double pitch = 0;       ///< for a screw joint, m/rad; its coordinate is the angle
  double lower = -none, upper = none, rate = none, effort = none;
  double soft_lower = -none, soft_upper = none;  ///< range at whose ends a safety controller begins to brake
  robot_joint_dynamics dynamics;
  /// A coordinate that follows that of another `joint`, with `ratio` and `offset`.
  struct follower {
    std::string joint;
    double ratio = 1, offset = 0;
  };
  std::optional<follower> mimic;  ///< q = ratio q_joint + offset
  double reference = 0;           ///< the coordinate at the configuration of the file
};

/// Whether the coordinate of a joint is one number.
[[nodiscard]] inline bool has_one_coordinate(const robot_joint& j) {
  using enum robot_joint::kind;
  return j.is == revolute || j.is == prismatic || j.is == screw;
}

/// What closes a loop of links and joints: a closure between frames of two links (docs/loops.md), or between two
/// joints. `kind`: points (coincident), frames (coincident), hinge, universal, cylindrical, sliding, point_on_line,
/// point_on_plane, distance; joints; `is`: the kind of this closure. `name` and `line` as in the file.
struct robot_closure {
  enum class kind {
    points,
    frames,
    hinge,
    universal,
    cylindrical,
    sliding,
    point_on_line,
    point_on_plane,
    distance,
    joints
  };
  std::string name;
  int line = 0;
  std::string file{};  ///< as of notes
  kind is = kind::points;
  std::string link1, link2;            ///< of joints their names
  robot_pose origin1, origin2;         ///< frames of the closure in the links
  vec3<> axis{1, 0, 0};                ///< unit axis in axes of both frames; universal: of the first, plane: its normal
  vec3<> axis2{0, 1, 0};               ///< universal: unit axis of the second frame
  double length = 0;                   ///< distance, m
  std::array<double, 5> polynomial{};  ///< of joints: q_1 = c_0 + c_1 q_2 + ... + c_4 q_2^4
};

/// An exception to the contacts of a file: none between two links (`excluded`), or one between two shapes whatever
/// their types; `line` in the file.
struct robot_contact_pair {
  std::string name1, name2;  ///< of links if excluded, else of shapes
  bool excluded = false;
  std::optional<double> friction;  ///< of the pair, if the file has it
  int line = 0;
  std::string file{};  ///< as of notes
};

/// The actuator of a joint: the gear ratio n, and the law of the actuator, before the gear. With its force f the force
/// of the joint is n f; its position and rate are n times those of the joint. `name`, `line`: as in the file.
struct robot_actuator {
  std::string name;
  int line = 0;
  std::string joint;
  double gear = 1;
  motor_law law{};             ///< for URDF with the gain 1/n: its commands are forces of joints
  std::string not_modelled{};  ///< the part of its law that is not modelled, such as "muscle"; else empty
};

/// A configuration with a `name`, such as a keyframe of MJCF: the numbers of q of joints, by their names; `line` in the
/// file.
struct robot_configuration {
  std::string name;
  int line = 0;
  std::vector<std::pair<std::string, std::vector<double>>> joints;
};

/// A robot as its file describes it: `name`, `links`, `joints`, `closures` of loops, fixed `frames`, `actuators`, named
/// `configurations` and `contact_pairs`. `to_robot` makes a chain of it.
struct robot_description {
  std::string name;
  std::string source;              ///< name of the file in messages
  std::vector<std::string> files;  ///< paths of other files that were read: those it includes, and of MJCF its assets
  std::vector<robot_link> links;
  std::vector<robot_joint> joints;
  std::vector<robot_closure> closures;
  std::vector<robot_frame> frames;
  std::vector<robot_actuator> actuators;
  std::vector<robot_configuration> configurations;
  std::vector<robot_contact_pair> contact_pairs;
  std::optional<vec3<>> gravity;     ///< in the file, m/s^2; empty if it has none
  std::vector<robot_note> not_read;  ///< contents of the file that the description does not have
  std::vector<robot_note> warnings;  ///< probable mistakes
};

namespace detail {
/// "arm.urdf:37: ", without the parts that are unknown.
inline std::string place_text(const std::string& source, int line) {
  if (source.empty()) return line > 0 ? "line " + std::to_string(line) + ": " : "";
  return source + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
}
}  // namespace detail

}  // namespace kte
