#pragma once

#include <kte/contract/key.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <string>
#include <vector>

/// What may be said of the answers that are needed of `inverse_kinematics`, in addition to the pose.
namespace kte {

/// The reference of the arm angle: where the elbow of an arm of seven axes is at the arm angle 0.
enum class arm_angle_from {
  stereographic,  ///< as detail/srs_axes.hpp says: without direction only where the wrist is straight below the
                  ///< shoulder
  first_axis      ///< on the side to which axis 1 points, for most arms above: without direction all along that axis
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
