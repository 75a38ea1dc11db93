#pragma once

#include <array>

namespace kte::detail {

/// The quartic through values y_0 ... y_4 at equal distances lies, between them, within the hull of its Bernstein
/// coefficients. These are y_0, the three results of this function, and y_4:
///
///   b_1 = (-13 y_0 + 48 y_1 - 36 y_2 + 16 y_3 - 3 y_4) / 12
///   b_2 = (13 y_0 - 64 y_1 + 120 y_2 - 64 y_3 + 13 y_4) / 18,   b_3 like b_1, mirrored
///
/// Farouki, The Bernstein polynomial basis, Comput. Aided Geom. Design 29 (2012), 3; solved for values at i/4.
template <class S>
std::array<S, 3> inner_bernstein(const std::array<S, 5>& y) {
  return {S((-13 * y[0] + 48 * y[1] - 36 * y[2] + 16 * y[3] - 3 * y[4]) / 12),
          S((13 * (y[0] + y[4]) - 64 * (y[1] + y[3]) + 120 * y[2]) / 18),
          S((-13 * y[4] + 48 * y[3] - 36 * y[2] + 16 * y[1] - 3 * y[0]) / 12)};
}

/// The largest distance of the values y_1, y_3, y_5, y_7 from the quartic through y_0, y_2, y_4, y_6, y_8.
template <class S>
S quartic_misfit(const std::array<S, 9>& y) {
  const auto outer = [](const S& a, const S& b, const S& c, const S& d, const S& e) {
    return S((35 * a + 140 * b - 70 * c + 28 * d - 5 * e) / 128);  // between a and b
  };
  const auto inner = [](const S& a, const S& b, const S& c, const S& d, const S& e) {
    return S((-5 * a + 60 * b + 90 * c - 20 * d + 3 * e) / 128);  // between b and c
  };
  const std::array<S, 4> misses{
      S(outer(y[0], y[2], y[4], y[6], y[8]) - y[1]), S(inner(y[0], y[2], y[4], y[6], y[8]) - y[3]),
      S(inner(y[8], y[6], y[4], y[2], y[0]) - y[5]), S(outer(y[8], y[6], y[4], y[2], y[0]) - y[7])};
  S most(0);
  for (const S& m : misses) most = m > most ? m : -m > most ? S(-m) : most;
  return most;
}

}  // namespace kte::detail
