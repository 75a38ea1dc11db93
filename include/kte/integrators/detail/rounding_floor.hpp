#pragma once

#include <limits>

namespace kte::detail {

/// What of the errors of steps is rounding, which shorter steps do not cure. As times and states are rounded, f is off
/// by about
///
///   d = f(t + eps |t|, x + eps |x|) - f(t, x)          (1)
///
/// and the error of a step of length h by h c d, where c is the share that the method has of it. Where that is more
/// than the tolerances, errors are compared with it.
///
/// No more than 1e5 eps |f| is taken for rounding: f may have jumped between the two times or states.
template <class S>
class rounding_floor {
 public:
  /// c
  explicit rounding_floor(double share) : share_(static_cast<S>(share)) {}
  /// Whether errors of at most 1 are what they seem.
  bool is_below() const { return size_ == S(0); }
  /// The error of a try, seen from the floor. `tries`: until now; slope(), rounding(): the norms of f and of (1), of
  /// which the second one takes an evaluation; it is asked for after rejections, and seldom.
  template <class Slope, class Rounding>
  S above(const S& error, const S& length, long long tries, const Slope& slope, const Rounding& rounding) {
    const S reach = length * share_;
    if (tries - measured_ >= (S(1) < error ? 8 : 32)) {
      const S most = S(1e5) * std::numeric_limits<S>::epsilon() * slope();
      const S found = reach * most > S(1) ? rounding() : S(0);
      size_ = most < found ? most : reach * found > S(0.1) ? found : S(0);
      measured_ = tries;
    }
    const S floor = reach * size_;
    return S(1) < floor ? S(error / floor) : error;
  }

 private:
  S share_;
  S size_{0};                 ///< the norm of (1) where it matters
  long long measured_ = -32;  ///< tries until it was measured
};

}  // namespace kte::detail
