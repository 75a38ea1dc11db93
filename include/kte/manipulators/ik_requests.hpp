#pragma once

#include <kte/contract/key.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <string>
#include <vector>

/// Arguments of `inverse_kinematics` that select solutions, in addition to the pose.
namespace kte {

/// The reference of the arm angle: the position of the elbow at arm angle 0, for arms with seven axes.
enum class arm_angle_from {
  stereographic,  ///< defined in detail/srs_axes.hpp; undefined only if the wrist is straight below the shoulder
  first_axis      ///< the side to which axis 1 points, above for most arms; undefined if the wrist is on axis 1
};

/// Requests the solutions of an arm of seven axes at the arm angle psi, rad, about the line from shoulder to wrist,
/// from a `reference`.
struct arm_angle {
  double psi;
  arm_angle_from reference;
  constexpr explicit arm_angle(double angle, arm_angle_from from = arm_angle_from::stereographic)
      : psi(angle), reference(from) {}
};

/// Requests the solutions in which the first or the last joint of an arm of seven joints, `coordinate`, has a value,
/// rad or m.
struct locked_joint {
  std::string_view coordinate;
  double value;
};
/// Requests solutions with a joint, by its key or name, locked at a value, rad or m.
template <key_type Key>
[[nodiscard]] constexpr locked_joint locked(const Key&, double value) {
  return {Key::name, value};
}
[[nodiscard]] constexpr locked_joint locked(std::string_view coordinate, double value) { return {coordinate, value}; }

/// Requests the solution within limits that is nearest to the posture q.
template <class Q>
struct nearest_to {
  const Q& q;
};
/// Requests the solution within limits that is nearest to the posture q.
template <indexable Q>
[[nodiscard]] constexpr nearest_to<Q> nearest(const Q& q) {
  return {q};
}

}  // namespace kte
