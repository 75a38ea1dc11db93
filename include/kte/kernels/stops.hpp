#pragma once

#include <kte/math/select.hpp>

/// Stops that push but never pull.
namespace kte::detail {

/// The excess of x above `upper`, or, negative, below `lower`; otherwise 0. NaN stays NaN.
template <class T>
KTE_INLINE constexpr T beyond(const T& x, const T& lower, const T& upper) {
  return select(x > upper, T(x - upper), T(select(x < lower, T(x - lower), T(x - x))));
}
/// The force of a stop of stiffness k and damping c that is compressed by d, at the rate d':
///
///   s = k d + c d' for d > 0, at least 0;  for d < 0, at most 0;  otherwise 0
template <class T>
KTE_INLINE constexpr T stop_force(const T& d, const T& rate, const T& k, const T& c) {
  const T s = k * d + c * rate, none = s - s;  // zero, but NaN stays NaN
  return select(d > T(0), T(select(s > T(0), s, none)), T(select(d < T(0), T(select(s < T(0), s, none)), T(d - d))));
}

}  // namespace kte::detail
