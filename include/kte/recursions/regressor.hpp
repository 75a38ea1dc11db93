#pragma once

#include <kte/math/matrix.hpp>

#include <array>

/// The regressor of inverse dynamics: forces by inertial parameters.
namespace kte::engine {

/// A number for each inertial parameter of a body, in the order of `inertial_parameters` (dynamics/regressor.hpp):
///
///   m,  m c_x, m c_y, m c_z,  I_xx, I_xy, I_yy, I_xz, I_yz, I_zz          (1)
template <class S>
using per_parameter = std::array<S, 10>;
/// Parameter i of a body with `count` parameters: in the plane four, m, m c_x, m c_y, I_zz; otherwise all ten.
template <class S>
KTE_INLINE const S& parameter_at(const per_parameter<S>& all, int i, int count) {
  constexpr std::array<std::size_t, 4> in_plane{0, 1, 2, 9};
  return all[count == 4 ? in_plane[static_cast<std::size_t>(i)] : static_cast<std::size_t>(i)];
}

/// The power of the body wrench for a motion x on a velocity v, u of its frame, by inertial parameters. The
/// Newton-Euler equations are linear in them (Atkeson, An, Hollerbach 1986): with h = m c and I about the origin,
///
///   f = m a + al x h + w x (w x h),   n = I al + w x I w + h x a                                  (2)
///   v . f + u . n = m (v . a) + h . (v x al + (v x w) x w + a x u) + u . I al + (u x w) . I w      (3)
template <class S, class Motion>
KTE_INLINE per_parameter<S> power_by_parameters(const Motion& x, const vec3<S>& v, const vec3<S>& u) {
  const vec3<S>&a = x.acceleration, &w = x.ang_velocity, &al = x.ang_acceleration;
  const vec3<S> h = cross(v, al) + cross(cross(v, w), w) + cross(a, u), d = cross(u, w);
  return {S(dot(v, a)),
          h.x,
          h.y,
          h.z,
          S(u.x * al.x + d.x * w.x),
          S((u.x * al.y + u.y * al.x) + (d.x * w.y + d.y * w.x)),
          S(u.y * al.y + d.y * w.y),
          S((u.x * al.z + u.z * al.x) + (d.x * w.z + d.z * w.x)),
          S((u.y * al.z + u.z * al.y) + (d.y * w.z + d.z * w.y)),
          S(u.z * al.z + d.z * w.z)};
}

/// The forces on axes for the motion x of a body, by inertial parameters: put(k, y) for each column of the Jacobian of
/// the frame of the body, in its own axes. columns(f) calls f(k, v, u) for them: `frame_columns` of
/// recursions/world_joints.hpp for static chains, those of tree/jacobian.hpp for loops.
template <class S, class Motion, class Columns, class Put>
KTE_INLINE void forces_by_parameters(const Motion& x, const Columns& columns, const Put& put) {
  columns([&](int k, const vec3<S>& v, const vec3<S>& u) KTE_INLINE_LAMBDA { put(k, power_by_parameters(x, v, u)); });
}

}  // namespace kte::engine
