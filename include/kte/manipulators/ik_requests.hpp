#pragma once

#include <kte/contract/key.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <string>
#include <vector>

/// What may be said of the answers that are wanted of `inverse_kinematics`, besides the pose.
namespace kte {

/// Where the elbow of an arm of seven axes is when its arm angle is 0.
enum class arm_angle_from {
  stereographic,  ///< as detail/srs_axes.hpp says: without direction only where the wrist is straight below the
                  ///< shoulder
  first_axis      ///< on the side to which axis 1 points, for most arms above: without direction all along that axis
};

/// Those of an arm of seven axes whose elbow stands at the angle psi, rad, about the line from shoulder to wrist.
struct arm_angle {
  double psi;
  arm_angle_from reference;
  constexpr explicit arm_angle(double angle, arm_angle_from from = arm_angle_from::stereographic)
      : psi(angle), reference(from) {}
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
