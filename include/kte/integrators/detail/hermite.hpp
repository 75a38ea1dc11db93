#pragma once

namespace kte::detail {

/// The cubic with value 0 and slope f0 at the start of a step h, and value d and slope f1 at its end, at the fraction
/// theta, as an Eigen expression of d, f0 and f1:
///
///   theta d + theta (theta - 1) [(1 - 2 theta) d + (theta - 1) h f0 + theta h f1]
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, II.6, (6.7).
template <class S, class D, class R>
auto hermite_cubic(const S& theta, const S& h, const D& d, const R& f0, const R& f1) {
  const S r = S(1) - theta, rt = r * theta;
  return (theta + rt * (theta - r)) * d + (rt * r * h) * f0 - (rt * theta * h) * f1;
}
/// The derivative of `hermite_cubic` by time.
template <class S, class D, class R>
auto hermite_slope(const S& theta, const S& h, const D& d, const R& f0, const R& f1) {
  const S r = S(1) - theta;
  return (6 * theta * r / h) * d + (r * (1 - 3 * theta)) * f0 + (theta * (3 * theta - 2)) * f1;
}

}  // namespace kte::detail
