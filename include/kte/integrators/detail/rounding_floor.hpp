#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// The part of step errors that is due to rounding, and that shorter steps do not reduce. Because times and states are
/// rounded, f has an error of about
///
///   d = f(t + eps |t|, x + eps |x|) - f(t, x)          (1)
///
/// and a step of length h an error of h c d, with a factor c of the method. For implicit methods d is replaced by W^-1
/// d, its effect on a stiff system. If this exceeds the tolerances, errors are compared with it instead.
///
/// Beyond 1e5 eps |f|, f may have jumped between the two times or states, or it is the difference of large terms, as in
/// a controlled system that comes to rest. (1) is then the smallest of three differences: over one rounding forward,
/// over one backward, and from one rounding to two. A jump affects at most two of them.
template <class S>
class rounding_floor {
 public:
  /// Whether rounding is below the tolerances.
  bool is_below() const { return size_ == S(0); }
  /// The norm of (1), if it exceeds the tolerances.
  const S& size() const { return size_; }
  /// The factor on the tolerances for the error of a try. reach: h c. `tries`: the number of tries so far. slope(): the
  /// norm of f. rounding(i, j): the norm of the difference of f between i and j roundings away, one evaluation for each
  /// nonzero index. It is called only after rejections, and seldom.
  template <class Slope, class Rounding>
  S level(const S& error, const S& reach, long long tries, const Slope& slope, const Rounding& rounding) {
    if (tries - measured_ >= (S(1) < error ? patience_ : 32)) {
      const S most = S(1e5) * std::numeric_limits<S>::epsilon() * slope();
      S found = reach * most > S(1e-3) ? rounding(0, 1) : S(0);
      if (most < found) found = least(least(found, rounding(0, -1)), rounding(1, 2));
      patience_ = reach * found > S(1e-3) ? 8 : 64;
      size_ = reach * found > S(0.1) ? found : S(0);
      measured_ = tries;
    }
    const S floor = reach * size_;
    return S(1) < floor ? floor : S(1);
  }

 private:
  /// The larger of a and b; a if b is NaN.
  static S least(const S& a, const S& b) { return b < a ? b : a; }

  S size_{0};                 ///< the norm of (1), if it exceeds the tolerances
  long long measured_ = -64;  ///< number of tries at the last measurement
  int patience_ = 64;         ///< tries until a rejection triggers a new measurement
};

/// The error of a k-th difference of numbers with independent errors of size 1:
///
///   sqrt(sum_j binomial(k, j)^2) = sqrt(binomial(2 k, k))          (2)
inline double rounding_of_difference(int k) {
  double square = 1;
  for (int j = 1; j <= k; ++j) square *= static_cast<double>(k + j) / j;
  return std::sqrt(square);
}

}  // namespace kte::detail
