#pragma once

#include <kte/recursions/world_joints.hpp>

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

/// The body wrench for a motion x of the frame of a body, by inertial parameters. The Newton-Euler equations are linear
/// in them (Atkeson, An, Hollerbach 1986): with h = m c and I about the origin,
///
///   f = m a + al x h + w x (w x h),   n = I al + w x I w + h x a          (2)
template <class S>
struct wrench_by_parameters {
  using by_moment = std::array<S, 4>;   ///< by m and h
  using by_inertia = std::array<S, 6>;  ///< by I
  std::array<by_moment, 3> force, torque;
  std::array<by_inertia, 3> torque_of_inertia;

  template <class Motion>
  KTE_INLINE explicit wrench_by_parameters(const Motion& x) {
    const vec3<S>&a = x.acceleration, &w = x.ang_velocity, &al = x.ang_acceleration;
    const S o(0), xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z, xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
    force = {by_moment{a.x, S(-yy - zz), S(xy - al.z), S(xz + al.y)},
             by_moment{a.y, S(xy + al.z), S(-xx - zz), S(yz - al.x)},
             by_moment{a.z, S(xz - al.y), S(yz + al.x), S(-xx - yy)}};
    torque = {by_moment{o, o, a.z, S(-a.y)}, by_moment{o, S(-a.z), o, a.x}, by_moment{o, a.y, S(-a.x), o}};
    torque_of_inertia = {by_inertia{al.x, S(al.y - xz), S(-yz), S(al.z + xy), S(yy - zz), yz},
                         by_inertia{xz, S(al.x + yz), al.y, S(zz - xx), S(al.z - xy), S(-xz)},
                         by_inertia{S(-xy), S(xx - yy), xy, S(al.x - yz), S(al.y + xz), al.z}};
  }
  /// Its power on a velocity v, u of the frame:
  ///
  ///   v . f + u . n          (3)
  KTE_INLINE per_parameter<S> power_on(const vec3<S>& v, const vec3<S>& u) const {
    per_parameter<S> y;
    for (std::size_t i = 0; i < 4; ++i)
      y[i] = (v.x * force[0][i] + v.y * force[1][i] + v.z * force[2][i]) +
             (u.x * torque[0][i] + u.y * torque[1][i] + u.z * torque[2][i]);
    for (std::size_t i = 0; i < 6; ++i)
      y[4 + i] = u.x * torque_of_inertia[0][i] + u.y * torque_of_inertia[1][i] + u.z * torque_of_inertia[2][i];
    return y;
  }
};

/// The forces on the axes of joint i and of all joints before it for the motion x of a body, by inertial parameters:
/// put(k, y) for each axis k; y uses the column of axis k in the Jacobian of the frame of the body. `rotation`: of this
/// frame in the world; `way`: from the end of joint i to it, in axes of the world.
template <class S, world_joints T, class Motion, class Put>
KTE_INLINE void forces_by_parameters(const T& t, int i, const mat3<vec3<S>>& rotation, vec3<S> way, const Motion& x,
                                     const Put& put) {
  const mat3<vec3<S>> in = transpose(rotation);
  const wrench_by_parameters<S> factors(x);
  for (; i >= 0; i = t.parent(i)) {
    for (int k = t.first(i); k < t.first(i) + t.axes(i); ++k) {
      const joint_axis<S>& s = t.axis(k);
      const vec3<S> v = in * (s.linear + cross(s.angular, way)), u = in * s.angular;
      put(k, factors.power_on(v, u));
    }
    way = t.step(i) + way;
  }
}

}  // namespace kte::engine
