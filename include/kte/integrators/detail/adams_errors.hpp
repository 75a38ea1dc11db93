#pragma once

#include <kte/detail/inline.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace kte::detail {

/// The squares of the norms e of the errors of a step of order k, and of what they would be with the orders beside it;
/// infinite where that is not known. An error of order k is as h^(k+1), so the step that brings it to one half is,
/// times the last one,
///
///   f_k = (1 / (2 e_k))^(1/(k+1))                          (1)
///
/// The order with the largest is taken. A method with a history prefers equal steps, so one grows by 1.2 to 2 or not at
/// all, and is 0.5 to 0.9 of the last one if it shrinks.
template <class S>
struct adams_errors {
  S same;
  S lower = std::numeric_limits<S>::infinity();
  S higher = lower;

  /// Not with the tolerances, but with what is more by this factor, squared.
  void compare_with(const S& square) { same /= square, lower /= square, higher /= square; }

  /// The step after one of this length was accepted, for which `proposed` had been chosen; sets its order.
  KTE_INLINE S next_step(const S& length, const S& proposed, int& order) const {
    float f = log_factor(same, order);
    const float fewer = log_factor(lower, order - 1), more = log_factor(higher, order + 1);
    if (f < fewer && more <= fewer) {
      f = fewer, --order;
    } else if (f < more) {
      f = more, ++order;
    }
    const S next = f < 0 ? length * factor(-1, f, log_09) : f < log_12 ? length : length * factor(0, f, 1);
    if (proposed <= length || proposed <= next) return next;
    return proposed < 10 * length ? proposed : S(10 * length);  // cut short, which says nothing about the next
  }
  /// The step after one of this length was rejected; sets its order.
  S shorter_step(const S& length, int& order) const {
    const float f = log_factor(same, order);
    if (lower < same) --order;
    return length * factor(-log_10, f, -1);
  }

 private:
  static constexpr float log_10 = 3.3219281f, log_12 = 0.2630344f, log_09 = -0.1520031f;  // to base 2, as all here

  /// 2^x, but not of an x out of this range; of `least` for an x that is not a number.
  KTE_INLINE static S factor(float least, float x, float most) {
    return S(std::exp2(x > most ? most : x > least ? x : least));
  }
  KTE_INLINE static float log_factor(const S& square, int order) {
    const S least = S(1e-36);
    return -0.5f * log_of(4 * static_cast<float>(square < least ? least : square)) / static_cast<float>(order + 1);
  }
  /// The logarithm to 0.001; at least 128 for infinity and NaN.
  KTE_INLINE static float log_of(float x) {
    constexpr std::uint32_t fraction = 0x7fffff, one = 0x3f800000;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const auto exponent = static_cast<float>(static_cast<int>(bits >> 23 & 0xff) - 127);
    const float m = std::bit_cast<float>((bits & fraction) | one);
    return exponent - 2.136232f + m * (3.011162f + m * (0.1527003f * m - 1.026805f));
  }
};

}  // namespace kte::detail
