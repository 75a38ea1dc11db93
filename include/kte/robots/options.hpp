#pragma once

#include <kte/math/vec.hpp>

#include <optional>
#include <string>
#include <vector>

namespace kte {

/// How a robot is read and made into a chain.
struct robot_options {
  /// Angles this near to a multiple of pi/2, rad, are taken for one, so that rotations have zeros and ones. Files with
  /// fewer digits need more: 1e-6 takes 1.570796 for pi/2.
  double quarter_turn_tolerance = 1e-15;
  /// In the axes of the root link, or of the world of a floating base, m/s^2. If left out, what the file says, and of
  /// formats that say nothing (0, 0, -9.81).
  std::optional<vec3<>> gravity{};
  /// The link that is the base of the chain; the file's root if empty. Joints on the way are turned round.
  std::string root{};
  /// Whether the root moves freely in `world`, by a coordinate of six degrees of freedom of the name `base_coordinate`.
  bool floating_base = false;
  std::string base_coordinate = "floating_base";
  std::string world = "world";
  /// Whether bodies of links that are fixed to others are added to theirs. Frames stay.
  bool fold_fixed = false;
  /// Whether damping and dry friction of joints become elements, as also springs and rotor inertias.
  bool joint_dynamics = true;
  /// Dry friction changes its sign over this rate, rad/s or m/s (docs/elements.md, `joint_friction`).
  double friction_smoothing = 1e-3;
  /// Refuses what moves differently from the robot of the file: every note that `changes_motion`. Else it is a warning.
  bool strict = false;
  /// The model of a file in SDF that has several (`models`).
  std::string model{};
  /// Folders in which files of `model://name/...` and `package://name/...` are looked for, after the folder of the
  /// robot's file and those around it.
  std::vector<std::string> search_path{};
};

/// What `add_motors` makes of a robot beside what its file says.
struct motor_options {
  /// Motors that follow a force become servos k (u - q) - c q', whose command u is where the joint should be: N/m or
  /// Nm/rad, N s/m or Nm s/rad. 0: they stay as they are. Those with gains in the file keep theirs.
  double stiffness = 0, damping = 0;
  /// Ranges of joints become stops (`joint_limit_gen`) of this stiffness and damping; 0: they do not.
  double stop_stiffness = 0, stop_damping = 0;
};

/// `load_robot(file, kte::strict)`: the options with `strict`.
struct strict_reading {
  operator robot_options() const {
    robot_options o;
    o.strict = true;
    return o;
  }
};
inline constexpr strict_reading strict{};

}  // namespace kte
