#pragma once

#include <kte/elements/compliant_contact.hpp>

#include <optional>
#include <string>
#include <vector>

namespace kte {

/// Contacts of the collision shapes of a robot with the ground (docs/robots.md, "Contacts").
struct robot_contact_options {
  /// The frame of the ground: a link or frame of the robot, or `robot_options::world`. Planes and height fields of
  /// links fixed to it are the ground; otherwise its plane z = 0. Without a name there are no contacts.
  std::string ground{};
  /// Coulomb's coefficient of friction. Without it, that of the file, or 1.
  std::optional<double> friction{};
  /// Newton's coefficient of restitution. Without it, that of the file, or 0.
  std::optional<double> restitution{};
  /// Compliant contacts by these parameters, with the friction from above, instead of rigid ones; without a stiffness
  /// rigid ones.
  compliant_contact_parameters compliant{};
  /// The rims of a cylinder as points, 3 to 64 each; 0: exact circles, which must not lie flat on the ground.
  int rim_points = 0;

  /// Whether there are contacts.
  bool requested() const { return !ground.empty(); }
  /// Whether they are compliant.
  bool are_compliant() const { return compliant.stiffness != 0; }
};

/// Options of reading a robot and making a chain of it.
struct robot_options {
  /// Angles within this distance of a multiple of pi/2, rad, are rounded to it, so that rotations have zeros and ones.
  /// Files with fewer digits need more: 1e-6 rounds 1.570796 to pi/2.
  double quarter_turn_tolerance = 1e-15;
  /// Gravity in the axes of the root link, or of the world for a floating base, m/s^2. Without it, that of the file, or
  /// (0, 0, -9.81) for formats without gravity.
  std::optional<vec3<>> gravity{};
  /// The link that is the base of the chain; the root of the file if empty. Joints between them are reversed.
  std::string root{};
  /// Whether the root moves freely in the frame `world`, by a coordinate of six degrees of freedom named
  /// `base_coordinate`.
  bool floating_base = false;
  /// The name of the coordinate of a floating base.
  std::string base_coordinate = "floating_base";
  /// The name of the frame in which a floating base moves.
  std::string world = "world";
  /// Whether bodies of links that are fixed to another link are merged into its body. Frames stay.
  bool fold_fixed = false;
  /// Whether damping, dry friction, springs and rotor inertias of joints become elements.
  bool joint_dynamics = true;
  /// Whether closures of loops become elements (docs/loops.md). Otherwise loops are open, with a warning of each.
  bool closures = true;
  /// Contacts with the ground; none by default.
  robot_contact_options contacts{};
  /// Dry friction changes its sign over this rate, rad/s or m/s (docs/elements.md, `joint_friction`).
  double friction_smoothing = 1e-3;
  /// Whether a robot that moves differently from that of the file is rejected: every note with `changes_motion`.
  /// Otherwise these are warnings.
  bool strict = false;
  /// The model to read from an SDF file with several (`models`).
  std::string model{};
  /// Folders to search for files `model://name/...` and `package://name/...`, after the folder of the robot's file and
  /// its parents.
  std::vector<std::string> search_path{};
};

/// Options of `add_motors`.
struct motor_options {
  /// Stiffness and damping of servos k (u - q) - c q', whose command u is the desired position, N/m or Nm/rad, N s/m or
  /// Nm s/rad, instead of motors whose command is a force; 0: unchanged. Motors with gains in the file are unchanged.
  double stiffness = 0, damping = 0;
  /// Stiffness and damping of stops at the ends of the ranges of joints (`joint_limit_gen`); 0: no stops.
  double stop_stiffness = 0, stop_damping = 0;
};

/// The type of `strict`, which converts to options with `strict`.
struct strict_reading {
  operator robot_options() const {  // NOLINT(google-explicit-constructor)
    robot_options o;
    o.strict = true;
    return o;
  }
};
/// Options with `strict`: `load_robot(file, kte::strict)`.
inline constexpr strict_reading strict{};

}  // namespace kte
