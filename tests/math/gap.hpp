#pragma once

#include <kte/math/axis_angle.hpp>

#include "catch.hpp"

/// How far apart two vectors, matrices or rotations are: the largest difference of an entry.
namespace kte::test {

template <class S>
S size(const S& a) {
  return a < 0 ? S(-a) : a;
}
template <class S>
S gap(const vec3<S>& a, const vec3<S>& b) {
  return worse(worse(size(S(a.x - b.x)), size(S(a.y - b.y))), size(S(a.z - b.z)));
}
template <class S>
S gap(const mat3<vec3<S>>& a, const mat3<vec3<S>>& b) {
  return worse(worse(gap(a.x, b.x), gap(a.y, b.y)), gap(a.z, b.z));
}
/// Of rotations: q and -q are the same.
template <class S>
S gap(const unit_quaternion<S>& a, const unit_quaternion<S>& b) {
  const S s = dot(a, b) < 0 ? S(-1) : S(1);
  return worse(size(S(a.w - s * b.w)), gap(vec3<S>{a.x, a.y, a.z}, vec3<S>{s * b.x, s * b.y, s * b.z}));
}
/// The axis of a small rotation is known to eps/angle.
template <class S>
S gap(const axis_angle<S>& a, const axis_angle<S>& b) {
  return worse(size(S(a.angle - b.angle)), S((a.angle < 1 ? a.angle : S(1)) * gap(a.axis, b.axis)));
}

}  // namespace kte::test
