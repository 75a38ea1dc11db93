#pragma once

#include <kte/math/select.hpp>

/// Stops that touch and push, but never pull.
namespace kte::detail {

/// How far x is above `upper`, or, negative, below `lower`; else 0. NaN stays.
template <class T>
KTE_INLINE constexpr T beyond(const T& x, const T& lower, const T& upper) {
  return select(x > upper, T(x - upper), T(select(x < lower, T(x - lower), T(x - x))));
}
/// The force of a stop of stiffness k and damping c that is pressed in by d, at the rate d':
///
///   s = k d + c d' for d > 0, but never below 0;  for d < 0, never above;  else 0
template <class T>
KTE_INLINE constexpr T stop_force(const T& d, const T& rate, const T& k, const T& c) {
  const T s = k * d + c * rate, none = s - s;  // zero, but NaN stays NaN
  return select(d > T(0), T(select(s > T(0), s, none)), T(select(d < T(0), T(select(s < T(0), s, none)), T(d - d))));
}

}  // namespace kte::detail
