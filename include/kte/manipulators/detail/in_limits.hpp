#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>

namespace kte::detail {

/// Turns an angle by whole turns to where it is within limits, nearest to `start` of what is; says whether it is. What
/// is beyond a limit by rounding alone is put on it. A slide does not turn.
template <class S, class Start>
bool bring_within(double lower, double upper, bool slides, const Start& start, S& t) {
  const S pi = half_turn<S>(), away = t - S(start);
  if (t >= S(lower) && t <= S(upper) && (slides || (away >= -pi && away <= pi))) return true;
  const auto reaches = [](const S& limit) {
    const S size = limit < S(0) ? S(-limit) : limit;
    return S(32 * std::numeric_limits<S>::epsilon()) * (size > S(1) ? size : S(1));
  };
  S x = t;
  const S least = S(lower) - (lower > -1e300 ? reaches(S(lower)) : S(0));
  const S most = S(upper) + (upper < 1e300 ? reaches(S(upper)) : S(0));
  if (!slides) {
    const S turn = S(2) * pi;
    const auto turns = [&turn](const S& way) { return double_of(S(way / turn)); };
    const double nearest = std::floor(turns(S(S(start) - x)) + 0.5);
    if (nearest != 0) x += S(nearest) * turn;
    if (x > most) x -= S(std::ceil(turns(S(x - most)))) * turn;
    if (x < least) x += S(std::ceil(turns(S(least - x)))) * turn;
  }
  if (x < least || x > most) return false;
  if (x < S(lower)) x = S(lower);
  if (x > S(upper)) x = S(upper);
  t = x;
  return true;
}

}  // namespace kte::detail
