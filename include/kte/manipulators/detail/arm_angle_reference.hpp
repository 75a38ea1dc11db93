#pragma once

#include <kte/manipulators/detail/srs_axes.hpp>
#include <kte/manipulators/ik_requests.hpp>

namespace kte::detail {

/// The offset from an arm angle with the given reference to the stereographic arm angle, for an arm with its wrist at
/// `position`: for the first axis, h1, the angle of
///
///   e = (w^ x h1) x w^          (1)
///
/// from e_x of detail/srs_axes.hpp (the common reference: Shimizu et al. 2008). 0 if e vanishes.
template <class S>
S to_stereographic(const arm_structure& s, const vec3<S>& position, arm_angle_from reference) {
  if (reference == arm_angle_from::stereographic) return S(0);
  const auto side = elbow_sides(s, position)[0];
  const vec3<S> h = as<S>(s.h(0)), e = h - dot(h, side.w) * side.w;
  return direction(S(dot(side.ex, e)), S(dot(side.ey, e))).value();
}

}  // namespace kte::detail
