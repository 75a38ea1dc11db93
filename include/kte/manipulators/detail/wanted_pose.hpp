#pragma once

#include <kte/errors.hpp>
#include <kte/manipulators/detail/solve_closed_form.hpp>
#include <kte/math/quaternion.hpp>

namespace kte::detail {

template <class X, class Y>
auto in_space(const vec2<X, Y>& p) {
  return planar(p);
}
template <class X, class Y, class Z>
const vec3<X, Y, Z>& in_space(const vec3<X, Y, Z>& p) {
  return p;
}
/// A planar or spatial pose as a spatial pose.
template <class Rotation, class Position>
auto spatial(const pose<Rotation, Position>& x) {
  const auto p = in_space(x.position);
  using S = scalar_of<decltype(dot(p, p))>;
  return plain_pose_of<S>{as<S>(matrix(x.rotation)), as<S>(p)};
}

/// A valid pose. The rotation is orthonormalized by two steps of R (3 - R^T R) / 2, unless it is orthonormal to
/// rounding. Throws `bad_argument` for numbers that are not finite or have no finite square, and for a matrix that is
/// not right-handed and orthonormal to 1e-6 (float: to a thousand rounding errors).
template <class S>
plain_pose_of<S> checked_pose(plain_pose_of<S> x) {
  auto& R = x.rotation;
  const vec3<S>& p = x.position;
  if (!all(dot(p, p) * S(0) == S(0)))
    raise<bad_argument>("kte: inverse kinematics: the position, or its square, is not finite");
  const S eps = S(std::numeric_limits<S>::epsilon());
  const S most = select(eps > S(1e-9), S(S(1000) * eps), S(1e-6));
  const auto off = [&R] {
    S worst(0);
    const auto look = [&worst](const S& d) {
      const S size = size_of(d);
      worst = select(size <= worst, worst, size);
    };
    look(dot(R.x, R.x) - S(1)), look(dot(R.y, R.y) - S(1)), look(dot(R.z, R.z) - S(1));
    look(dot(R.x, R.y)), look(dot(R.y, R.z)), look(dot(R.z, R.x));
    return worst;
  };
  const S away = off();
  if (!all(both<truth<S>>(away <= most, dot(R.x, cross(R.y, R.z)) > S(0))))
    raise<bad_argument>("kte: inverse kinematics: the rotation must be orthonormal and right-handed");
  if (any(away > S(8) * eps))
    for (int k = 0; k < 2; ++k) R = as<S>(S(0.5) * (R * as<S>(diagonal_matrix(S(3)) - transpose(R) * R)));
  return x;
}

}  // namespace kte::detail
