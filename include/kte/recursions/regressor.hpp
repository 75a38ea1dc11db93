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
///
/// V: S, or several numbers side by side, for as many velocities.
template <class S, class V, class Motion>
KTE_INLINE void power_by_parameters(const Motion& x, const vec3<V>& v, const vec3<V>& u, per_parameter<V>& y) {
  const vec3<S>&a = x.acceleration, &w = x.ang_velocity, &al = x.ang_acceleration;
  const vec3<V> c{v.y * w.z - v.z * w.y, v.z * w.x - v.x * w.z, v.x * w.y - v.y * w.x};  // v x w
  const vec3<V> d{u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x};  // u x w
  y[0] = v.x * a.x + v.y * a.y + v.z * a.z;
  y[1] = (v.y * al.z - v.z * al.y) + (c.y * w.z - c.z * w.y) + (u.z * a.y - u.y * a.z);
  y[2] = (v.z * al.x - v.x * al.z) + (c.z * w.x - c.x * w.z) + (u.x * a.z - u.z * a.x);
  y[3] = (v.x * al.y - v.y * al.x) + (c.x * w.y - c.y * w.x) + (u.y * a.x - u.x * a.y);
  y[4] = u.x * al.x + d.x * w.x;
  y[5] = (u.x * al.y + u.y * al.x) + (d.x * w.y + d.y * w.x);
  y[6] = u.y * al.y + d.y * w.y;
  y[7] = (u.x * al.z + u.z * al.x) + (d.x * w.z + d.z * w.x);
  y[8] = (u.y * al.z + u.z * al.y) + (d.y * w.z + d.z * w.y);
  y[9] = u.z * al.z + d.z * w.z;
}

/// The forces on axes for the motion x of a body, by inertial parameters: put(k, y) for each column of the Jacobian of
/// the frame of the body, in its own axes. columns(f) calls f(k, v, u) for them.
template <class S, class Motion, class Columns, class Put>
KTE_INLINE void forces_by_parameters(const Motion& x, const Columns& columns, const Put& put) {
  columns([&](int k, const vec3<S>& v, const vec3<S>& u) KTE_INLINE_LAMBDA {
    per_parameter<S> y;
    power_by_parameters<S>(x, v, u, y);
    put(k, y);
  });
}

}  // namespace kte::engine
