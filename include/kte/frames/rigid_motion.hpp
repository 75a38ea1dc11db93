#pragma once

#include <kte/frames/motion.hpp>
#include <kte/math/axis_angle.hpp>

namespace kte {

namespace detail {
/// The coefficients (1 - cos t)/t^2 and (t - sin t)/t^3 of a rotation by t about an axis, given t^2.
template <class S>
constexpr std::pair<S, S> turned_shift(const S& tt) {
  using std::sin;
  using std::sqrt;
  if (tt <= std::numeric_limits<S>::epsilon()) return {S(1) / S(2), S(1) / S(6)};  // next terms: t^2/24, t^2/120
  const S t = sqrt(tt), s = sin(S(t / S(2))) / t;
  return {S(2) * s * s, (t - sin(t)) / (t * tt)};
}
/// (1 - t/2 cot(t/2))/t^2, given t^2 <= pi^2.
template <class S>
constexpr S unturned_shift(const S& tt) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  if (tt <= std::numeric_limits<S>::epsilon()) return S(1) / S(12);  // next term: t^2/720
  const S half = sqrt(tt) / S(2);
  return (S(1) - half * cos(half) / sin(half)) / tt;
}
}  // namespace detail

/// The exponential of SE(3): the pose after unit time, from the identity, at constant velocity v and angular velocity w
/// in axes of the frame:
///
///   R = exp [w]x,   p = v + B w x v + C w x (w x v)                                             (1)
///   B = (1 - cos t)/t^2,  C = (t - sin t)/t^3,  t = |w|
///
/// The error of p is a few roundings of |v|: the factor t^2 removes the cancellation in C for small t.
template <class S>
[[nodiscard]] constexpr auto exponential(const vec3<S>& v, const vec3<S>& w) {
  const auto [b, c] = detail::turned_shift(dot(w, w));
  const auto wv = cross(w, v);
  return pose{to_quaternion(w), as<S>(v + (b * wv + c * cross(w, wv)))};
}

/// The velocity and angular velocity, |w| <= pi, by which (1) gives a pose:
///
///   v = p - w x p/2 + D w x (w x p),   D = (1 - t/2 cot(t/2))/t^2                               (2)
template <class S>
[[nodiscard]] constexpr std::pair<vec3<S>, vec3<S>> logarithm(const pose<unit_quaternion<S>, vec3<S>>& x) {
  const auto w = to_rotation_vector(x.rotation);
  const auto wp = cross(w, x.position);
  const S half = S(1) / S(2);
  return {as<S>(x.position + (detail::unturned_shift(dot(w, w)) * cross(w, wp) - half * wp)), w};
}

}  // namespace kte
