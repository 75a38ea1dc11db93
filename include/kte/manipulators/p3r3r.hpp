#pragma once

#include <kte/elements/prismatic_joint.hpp>
#include <kte/manipulators/three_r_three_r.hpp>

namespace kte {

/// The lengths of a CRS A465: 13, 12 and 13 inches, the flange 3 inches from the wrist.
inline constexpr three_r_three_r_lengths crs_a465{0.3302, 0.3048, 0.15, 0.1802, 0.0762};

/// An arm z -y -y z -y z on a track along x (`track`, m). Masses are assumed: a cart of 20 kg, and those of
/// `three_r_three_r_chain`.
[[nodiscard]] constexpr auto p3r3r_chain(const three_r_three_r_lengths& lengths = crs_a465) {
  using namespace arm_names;
  return chain(prismatic_joint_3D(track, base, cart, axis::x), inertia_3D(cart, point_mass(20.0)),
               detail::three_r_three_r_on(cart, lengths));
}
/// Limits: a track of 1 m, joints of half a turn in each direction.
[[nodiscard]] constexpr auto p3r3r_limits() {
  auto limits = unlimited(p3r3r_chain());
  limits.upper = detail::in_radians<7>({0, 180, 180, 180, 180, 180, 180});
  limits.lower = detail::negated(limits.upper);
  limits.lower[0] = 0, limits.upper[0] = 1;
  return limits;
}

/// The arm with its limits. `inverse_kinematics` returns the solutions for one position of the track (`locked`; by
/// default 0), or with `nearest` for the nearest position.
[[nodiscard]] constexpr auto p3r3r(const three_r_three_r_lengths& lengths = crs_a465) {
  return manipulator(p3r3r_chain(lengths), arm_names::tool, p3r3r_limits());
}

}  // namespace kte
