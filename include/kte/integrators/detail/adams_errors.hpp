#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// The norms of the errors of a step of order k, and of what they would be with the orders beside it; infinite where
/// that is not known. An error of order k is as h^(k+1), so the step that brings it to one half is, times the last one,
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

  /// The step after one of this length was accepted, for which `proposed` had been chosen; sets its order.
  S next_step(const S& length, const S& proposed, int& order) const {
    S f = factor(same, order);
    const S fewer = factor(lower, order - 1), more = factor(higher, order + 1);
    if (f < fewer && more <= fewer) {
      f = fewer, --order;
    } else if (f < more) {
      f = more, ++order;
    }
    const S next = length * (f < 1 ? between(S(0.5), f, S(0.9)) : f < S(1.2) ? S(1) : between(S(1), f, S(2)));
    if (proposed <= length || proposed <= next) return next;
    return proposed < 10 * length ? proposed : S(10 * length);  // cut short, which says nothing about the next
  }
  /// The step after one of this length was rejected; sets its order.
  S shorter_step(const S& length, int& order) const {
    const S f = factor(same, order);
    if (lower < same) --order;
    return length * between(S(0.1), f, S(0.5));
  }

 private:
  /// x, but not out of this range; `least` for an x that is not a number.
  static S between(const S& least, const S& x, const S& most) { return x > most ? most : x > least ? x : least; }
  static S factor(const S& error, int order) {
    using std::pow;
    const S least = S(1e-30);
    return pow(S(1 / (2 * (error < least ? least : error))), S(1 / S(order + 1)));  // (1)
  }
};

}  // namespace kte::detail
