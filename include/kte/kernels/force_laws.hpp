#pragma once

#include <kte/math/select.hpp>

#include <cmath>
#include <type_traits>

/// Forces as functions of a displacement and its rate: stops, dry friction, contact.
namespace kte::detail {

/// The excess of x above `upper`, or, negative, below `lower`; otherwise 0. NaN stays NaN.
template <class T>
KTE_INLINE constexpr T beyond(const T& x, const T& lower, const T& upper) {
  return select(x > upper, T(x - upper), T(select(x < lower, T(x - lower), T(x - x))));
}
/// The force of a stop of stiffness k and damping c that is compressed by d, at the rate d'. It pushes but never pulls:
///
///   s = k d + c d' for d > 0, at least 0;  for d < 0, at most 0;  otherwise 0
template <class T>
KTE_INLINE constexpr T stop_force(const T& d, const T& rate, const T& k, const T& c) {
  const T s = k * d + c * rate, none = s - s;  // zero, but NaN stays NaN
  return select(d > T(0), T(select(s > T(0), s, none)), T(select(d < T(0), T(select(s < T(0), s, none)), T(d - d))));
}

/// Stribeck's curve: the force of dry friction falls from Fs, where sliding begins, to Fc over rates of about vs:
///
///   g(v) = Fc + (Fs - Fc) exp(-(v/vs)^2)
template <class V>
KTE_INLINE constexpr auto stribeck_force(const V& v, double coulomb, double stiction, double stribeck_velocity) {
  using std::abs;
  using std::exp;
  using number = std::remove_cvref_t<decltype(v / stribeck_velocity)>;
  const number rate = abs(number(v / stribeck_velocity));
  const number r = select(rate > number(1e4), number(1e4), rate);  // exp(-r^2) is 0, but r^2 may overflow
  return coulomb + (stiction - coulomb) * number(exp(number(-(r * r))));
}

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
