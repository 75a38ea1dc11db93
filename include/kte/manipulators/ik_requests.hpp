#pragma once

#include <type_traits>

/// What may be said of the answers that are wanted of `inverse_kinematics`, besides the pose.
namespace kte {

/// Those of an arm of seven axes whose elbow stands at the angle psi, rad, about the line from shoulder to wrist
/// (detail/srs_axes.hpp says from where).
struct arm_angle {
  double psi;
  constexpr explicit arm_angle(double angle) : psi(angle) {}
};

}  // namespace kte
