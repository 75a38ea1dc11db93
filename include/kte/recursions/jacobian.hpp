#pragma once

#include <kte/engine/body.hpp>

#include <cstddef>

/// The Jacobian of a frame, column by column, for static and runtime chains and in any scalar. Each body that carries
/// the frame sees
///   rotation R   from axes of the body to those in which columns are written: of the frame, or of the world
///   p            the origin of the frame, from that of the body
namespace kte::engine {

/// R u. Vectors in registers have their own function (tree/direction.hpp).
template <class R, class U>
KTE_INLINE constexpr auto combined(const R& rotation, const U& u) {
  return rotation * u;
}
/// The column of an axis s of the body (Siciliano et al., Robotics, 2009, section 3.1.3), with p in axes of the column:
///
///   ( R s_v + R s_w x p, R s_w )          (1)
template <class R, class P, class V, class W>
KTE_INLINE constexpr auto jacobian_column(const R& rotation, const P& p, const motion_vector<V, W>& s) {
  const auto angular = combined(rotation, s.angular);
  return motion_vector{plus_cross(combined(rotation, s.linear), angular, p), fresh(angular)};
}
/// As (1), with p in axes of the body:
///
///   ( R (s_v + s_w x p), R s_w )          (2)
///
/// If s is a type, s_w x p costs nothing. Static chains take (2) for columns in axes of the frame; (1) would take 1.7
/// times as long. Elsewhere (2) is slower (docs/decisions/24-engine.md).
template <class R, class P, class V, class W>
KTE_INLINE constexpr auto jacobian_column_in_body(const R& rotation, const P& p, const motion_vector<V, W>& s) {
  return motion_vector{rotation * plus_cross(s.linear, s.angular, p), rotation * s.angular};
}

/// The columns of the Jacobian of a frame that follows others, by velocity(), which is linear in `rates`, at unit
/// rates.
template <class S, class J, class Rates, class Velocity>
void put_velocities_at_unit_rates(J& j, Rates& rates, const Velocity& velocity) {
  for (decltype(j.cols()) k = 0; k < j.cols(); ++k) {
    auto& rate = rates[static_cast<std::size_t>(k)];
    rate = S(1);
    const linear_angular<S> x = velocity();
    j.col(k) << x.linear.x, x.linear.y, x.linear.z, x.angular.x, x.angular.y, x.angular.z;
    rate = S(0);
  }
}
/// The velocities of a frame with motion m, in its own axes or in those of the world.
template <class S, class Motion>
linear_angular<S> velocities_of(const Motion& m, bool world) {
  const vec3<S> v = as<S>(m.velocity), w = as<S>(m.ang_velocity);
  if (!world) return {v, w};
  return {as<S>(matrix(m.rotation) * v), as<S>(matrix(m.rotation) * w)};
}

}  // namespace kte::engine
