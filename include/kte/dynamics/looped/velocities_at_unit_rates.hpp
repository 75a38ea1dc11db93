#pragma once

#include <kte/frames/motion.hpp>
#include <kte/math/eigen.hpp>

/// Jacobians of frames that follow others, by their velocities.
namespace kte::detail {

/// Columns of a Jacobian by velocity(), which is linear in `rates`, at unit rates.
template <class S, class J, class Rates, class Velocity>
void put_velocities_at_unit_rates(J& j, Rates& rates, const Velocity& velocity) {
  for (Eigen::Index k = 0; k < j.cols(); ++k) {
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

}  // namespace kte::detail
