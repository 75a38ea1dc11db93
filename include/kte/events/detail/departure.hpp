#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// The sign of a value, -1 or 1; within `noise` of zero the previous sign.
template <class S>
int sign_of(const S& y, const S& noise, int before) {
  return y > noise ? 1 : y < -noise ? -1 : before;
}

/// The side to which g departs from zero at the time a, and a time at which it is there. The side is 0 if g stays at
/// zero until b.
template <class S>
struct departure {
  int side;
  S time;
};
/// Tries times at increasing distances from a: 4 eps |a|, four times that, ... A flight of duration T is detected at a
/// time between T/4 and T. The dense output rounds in proportion to the distance from a, so g must exceed noise + 16
/// eps (t - a) |g(b)| / (b - a).
template <class S, class G>
departure<S> depart(G&& g, const S& a, const S& b, const S& noise) {
  using std::abs;
  const S eps = std::numeric_limits<S>::epsilon(), length = abs(S(b - a)), end = abs(S(g(b)));
  for (S d = 4 * eps * (abs(a) + eps * length);; d *= 4) {
    const bool last = !(d < length);
    const S t = last ? b : a < b ? S(a + d) : S(a - d);
    const S rounding = noise + 16 * eps * (last ? S(1) : S(d / length)) * end;
    const int side = sign_of(S(g(t)), rounding, 0);
    if (side != 0 || last) return {side, t};
  }
}

}  // namespace kte::detail
