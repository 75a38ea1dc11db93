#pragma once

#include <kte/contract/key.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <string>
#include <vector>

/// What may be said of the answers that are wanted of `inverse_kinematics`, besides the pose.
namespace kte {

/// Those of an arm of seven axes whose elbow stands at the angle psi, rad, about the line from shoulder to wrist
/// (detail/srs_axes.hpp says from where).
struct arm_angle {
  double psi;
  constexpr explicit arm_angle(double angle) : psi(angle) {}
};

/// Those in which a joint of an arm of seven, the first or the last, stands at a value, rad, of a slide m.
struct locked_joint {
  std::string_view coordinate;
  double value;
};
template <key_type Key>
constexpr locked_joint locked(const Key&, double value) {
  return {Key::name, value};
}
constexpr locked_joint locked(std::string_view coordinate, double value) { return {coordinate, value}; }

/// The one nearest to a posture, within limits.
template <class Q>
struct nearest_to {
  const Q& q;
};
template <indexable Q>
constexpr nearest_to<Q> nearest(const Q& q) {
  return {q};
}

}  // namespace kte
