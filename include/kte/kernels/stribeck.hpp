#pragma once

#include <kte/math/select.hpp>

#include <cmath>
#include <type_traits>

namespace kte::detail {

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

}  // namespace kte::detail
