#pragma once

#include <kte/manipulators/detail/raw_answers.hpp>
#include <kte/math/plain_scalar.hpp>

namespace kte::detail {

/// The integer nearest to x, |x| < 2^51 (float: 2^22), and the smallest integer not below x; without derivatives.
template <class S>
S nearest_whole(const S& x) {
  if constexpr (is_pack<S>) {
    const S large = S(sincos_numbers<typename S::value_type>::to_integer);
    return (x + large) - large;
  } else {
    return S(std::floor(double_of(x) + 0.5));
  }
}
template <class S>
S whole_above(const S& x) {
  const S n = nearest_whole(x);
  return select(n < x, S(n + S(1)), n);
}

/// Adds whole turns to an angle to bring it within limits, nearest to `start`; returns whether it is within limits. An
/// angle beyond a limit by rounding is moved onto it. Slides are unchanged.
template <class S>
truth<S> bring_within(double lower, double upper, bool slides, const S& start, S& t) {
  const S pi = half_turn<S>(), turn = S(2) * pi, away = t - start, low = S(lower), high = S(upper);
  truth<S> stays = both<truth<S>>(t >= low, t <= high);
  if (!slides) stays = both<truth<S>>(stays, both<truth<S>>(away >= -pi, away <= pi));
  if (all(stays)) return stays;
  const auto reaches = [](double limit) {
    const double size = std::abs(limit);
    return size < 1e300 ? S(32 * std::numeric_limits<plain_scalar<S>>::epsilon()) * S(size > 1 ? size : 1) : S(0);
  };
  const S least = low - reaches(lower), most = high + reaches(upper);
  S x = t;
  if (!slides) {
    x = x + nearest_whole(S((start - x) / turn)) * turn;
    x = select(x > most, S(x - whole_above(S((x - most) / turn)) * turn), x);
    x = select(x < least, S(x + whole_above(S((least - x) / turn)) * turn), x);
  }
  const truth<S> found = both<truth<S>>(!(x < least), !(x > most));
  x = select(x < low, low, select(x > high, high, x));
  const truth<S> changes = both<truth<S>>(!stays, found);
  t = select(changes, x, t);
  return !both<truth<S>>(!stays, !found);
}

}  // namespace kte::detail
