#pragma once

#include <kte/math/select.hpp>

#include <cmath>

namespace kte::detail {

/// The normal force of Hunt and Crossley for a gap g that changes at the rate g', N:
///
///   delta = max(0, -g),   lambda = max(0, k delta^p (1 - c g'))
template <class S>
KTE_INLINE constexpr S hunt_crossley(const S& gap, const S& rate, double k, double p, double c) {
  using std::pow;
  const S none = S(gap - gap), depth = select(gap < S(0), S(-gap), none), factor = S(S(1) - S(c) * rate);
  return S(S(k) * S(pow(depth, p)) * select(factor < S(0), none, factor));
}
/// Its energy without dissipation, J: k delta^(p + 1)/(p + 1).
template <class S>
KTE_INLINE constexpr S hertz_energy(const S& gap, double k, double p) {
  using std::pow;
  const S depth = select(gap < S(0), S(-gap), S(gap - gap));
  return S(S(k / (p + 1)) * S(pow(depth, p + 1)));
}

}  // namespace kte::detail
