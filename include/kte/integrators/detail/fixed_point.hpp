#pragma once

#include <kte/integrators/time_grid.hpp>

namespace kte::detail {

enum class iteration { converged, too_long, no_number };

/// Iterates y = g(y) to rounding error: until the change no longer falls and is below 1e-3 of the square root of
/// epsilon, relative to y. A contraction by a factor c then leaves an error of about epsilon / (1 - c).
///
/// step() does one iteration and returns the relative size of the change. A change that is not finite is attributed to
/// g, unless y has more than doubled before: then the iteration diverges. negligible(): whether the last change is
/// below rounding errors of something larger than y, as where y is a sum that cancels; then a change that no longer
/// falls is enough.
template <class S, class Step, class Negligible>
iteration iterate(const Step& step, const Negligible& negligible, int most = 60) {
  using std::sqrt;
  const S eps = std::numeric_limits<S>::epsilon(), tiny = S(1e-3) * sqrt(eps);
  S before = (std::numeric_limits<S>::max)();
  for (int i = 0; i < most; ++i) {
    const S change = step();
    if (!is_finite(change)) return i > 0 && before > S(0.5) ? iteration::too_long : iteration::no_number;
    if (change <= eps || (change >= before && (change < tiny || negligible()))) return iteration::converged;
    before = change;
  }
  return iteration::too_long;
}
template <class S, class Step>
iteration iterate(const Step& step, int most = 60) {
  return iterate<S>(
      step, [] { return false; }, most);
}

}  // namespace kte::detail
