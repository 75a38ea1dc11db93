#pragma once

#include <kte/frames/rigid_motion.hpp>

#include <Eigen/Core>

namespace kte {

/// How far a pose is from a wanted one, in axes of the world, as Jacobians and twists are:
///
///   e = (p_wanted - p, log(R_wanted R^T))            m, rad; angles in [0, pi]            (1)
///
/// The gradient of |e|^2/2 along a motion of twist t is exactly -e . t, for log keeps the direction of its axis. Throws
/// `bad_argument` for what is no rotation to 1e-6.
template <class R, class P, class WantedR, class WantedP>
auto pose_error(const pose<R, P>& now, const pose<WantedR, WantedP>& wanted) {
  const auto from = to_quaternion(now.rotation);
  using S = std::remove_cvref_t<decltype(from.w)>;
  auto turn = to_quaternion(wanted.rotation);
  turn = turn * conjugate(from);
  const auto w = to_rotation_vector(as<S>(turn));
  const auto p = as<S>(wanted.position) - as<S>(now.position);
  return Eigen::Matrix<S, 6, 1>{p.x, p.y, p.z, w.x, w.y, w.z};
}

}  // namespace kte
