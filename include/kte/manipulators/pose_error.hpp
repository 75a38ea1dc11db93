#pragma once

#include <kte/frames/rigid_motion.hpp>

#include <Eigen/Core>

namespace kte {

namespace detail {
/// Of a rotation in any form; throws `bad_argument` for what is none.
template <class R>
auto quaternion_of(const R& rotation) {
  if constexpr (requires { rotation.w; }) {
    return normalized(rotation.w, rotation.x, rotation.y, rotation.z);
  } else {
    return to_quaternion(matrix(rotation));
  }
}
}  // namespace detail

/// How far a pose is from a wanted one, in axes of the world, as Jacobians and twists are:
///
///   e = (p_wanted - p, log(R_wanted R^T))            m, rad; angles in [0, pi]            (1)
///
/// The gradient of |e|^2/2 along a motion of twist t is exactly -e . t, for log keeps the direction of its axis. Throws
/// `bad_argument` for what is no rotation to 1e-6.
template <class R, class P, class WantedR, class WantedP>
auto pose_error(const pose<R, P>& now, const pose<WantedR, WantedP>& wanted) {
  const auto from = detail::quaternion_of(now.rotation);
  using S = std::remove_cvref_t<decltype(from.w)>;
  const auto w = to_rotation_vector(as<S>(detail::quaternion_of(wanted.rotation)) * conjugate(from));
  const auto p = as<S>(wanted.position) - as<S>(now.position);
  Eigen::Matrix<S, 6, 1> e;
  e << p.x, p.y, p.z, w.x, w.y, w.z;
  return e;
}

}  // namespace kte
