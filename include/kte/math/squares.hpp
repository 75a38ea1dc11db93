#pragma once

#include <kte/math/select.hpp>

#include <cmath>
#include <limits>

/// Lengths of vectors whose squares overflow or underflow.
namespace kte::detail {

/// Whether a sum of squares is accurate: no square has overflowed, and no relevant square has underflowed.
template <class S>
KTE_INLINE constexpr bool keeps_digits(const S& sum) {
  using limits = std::numeric_limits<S>;
  if constexpr (!limits::is_specialized) return all(sum > S(0));  // its limits are unknown
  const S least = S((limits::min)()) / S(limits::epsilon()) / S(limits::epsilon());
  return all(sum > least) && all(sum < S(1) / least);
}
/// The factor for numbers whose sum of squares is not accurate; a constant, so that derivatives pass through.
template <class S>
constexpr S scale_for_squares(const S& sum) {
  using std::sqrt;
  if constexpr (!std::numeric_limits<S>::is_specialized) return S(1);
  const S root = sqrt(S((std::numeric_limits<S>::max)())), large = root * sqrt(root);
  return select(sum > S(1), S(S(1) / large), large);
}

}  // namespace kte::detail
