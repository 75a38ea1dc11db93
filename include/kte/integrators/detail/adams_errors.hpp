#pragma once

#include <kte/detail/inline.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace kte::detail {

/// The squared norms e of the errors of a step of order k, and of the neighbouring orders; infinite if unknown. An
/// error of order k is proportional to h^(k+1), so the step with an error of one half is the last step times
///
///   f_k = (1 / (2 e_k))^(1/(k+1))                          (1)
///
/// The order with the largest f_k is chosen. Methods with a history prefer equal steps: a step grows by 1.2 to 2 or not
/// at all, and shrinks to 0.5 to 0.9 of the last one.
template <class S>
struct adams_errors {
  S same;
  S lower = std::numeric_limits<S>::infinity();
  S higher = lower;

  /// Replaces the tolerances as the unit of errors by a multiple of them. `square`: the factor, squared.
  void compare_with(const S& square) { same /= square, lower /= square, higher /= square; }

  /// The length of the next step after an accepted step, for which `proposed` had been chosen; sets its order.
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
    return proposed < 10 * length ? proposed : S(10 * length);  // a step cut short says nothing about the next
  }
  /// The length of the next try after a rejected step; sets its order.
  S shorter_step(const S& length, int& order) const {
    const float f = log_factor(same, order);
    if (lower < same) --order;
    return length * factor(-log_10, f, -1);
  }

 private:
  static constexpr float log_10 = 3.3219281f, log_12 = 0.2630344f, log_09 = -0.1520031f;  // base 2

  /// 2^x for x in the range; the bound for other x; 2^least for NaN.
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
