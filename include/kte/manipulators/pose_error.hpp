#pragma once

#include <kte/frames/rigid_motion.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <Eigen/Core>

namespace kte {

namespace detail {
/// The matrix of a rotation in any form; throws `bad_argument` if it is not a rotation.
template <class R>
auto quaternion_of(const R& rotation) {
  if constexpr (requires { rotation.w; }) {
    return normalized(rotation.w, rotation.x, rotation.y, rotation.z);
  } else {
    return to_quaternion(matrix(rotation));
  }
}

/// log(R_desired R^T) of rotation matrices. With the axial vector s of E = R_desired R^T, of length 2 sin t,
///
///   log E = s t/|s|,   t = 2 atan2(|s|, 1 + tr E)          (2)
///
/// Near half a turn, where s loses digits, the quaternion is used instead.
template <class S>
vec3<S> turn_between(const mat3<vec3<S>>& now, const mat3<vec3<S>>& wanted) {
  using std::atan2;
  using std::sqrt;
  const auto E = as<S>(wanted * transpose(now));
  const S w = S(1) + E.x.x + E.y.y + E.z.z;
  if (!(w > S(0.5))) return to_rotation_vector(to_quaternion(E));
  const vec3<S> s{E.z.y - E.y.z, E.x.z - E.z.x, E.y.x - E.x.y};
  const S size = sqrt(dot(s, s));
  return (size > S(0) ? S(S(2) * atan2(size, w) / size) : S(0.5)) * s;
}
}  // namespace detail

/// The error of a pose relative to a desired pose, in axes of the world, like Jacobians and twists:
///
///   e = (p_desired - p, log(R_desired R^T))          m, rad; angles in [0, pi]            (1)
///
/// Along a motion with twist t, the time derivative of |e|^2/2 is exactly -e . t, because log keeps the direction of
/// the rotation axis. Throws `bad_argument` for a rotation that is not orthonormal to 1e-6, and for positions that are
/// not finite.
template <class R, class P, class WantedR, class WantedP>
[[nodiscard]] auto pose_error(const pose<R, P>& now, const pose<WantedR, WantedP>& wanted) {
  const auto from = detail::quaternion_of(now.rotation);
  using S = std::remove_cvref_t<decltype(from.w)>;
  const auto w = to_rotation_vector(as<S>(detail::quaternion_of(wanted.rotation)) * conjugate(from));
  const auto p = as<S>(wanted.position) - as<S>(now.position);
  Eigen::Matrix<S, 6, 1> e;
  e << p.x, p.y, p.z, w.x, w.y, w.z;
  detail::check_finite(e, 6, "kte: the error of a pose is not finite: a position is not finite or too large");
  return e;
}

}  // namespace kte
