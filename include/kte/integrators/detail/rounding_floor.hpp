#pragma once

#include <cmath>
#include <limits>

namespace kte::detail {

/// What of the errors of steps is rounding, which shorter steps do not cure. As times and states are rounded, f is off
/// by about
///
///   d = f(t + eps |t|, x + eps |x|) - f(t, x)          (1)
///
/// and the error of a step of length h by h c d, where c is the share that the method has of it; implicit methods see
/// W^-1 d, which is what a stiff system makes of d. Where that is more
/// than the tolerances, errors are compared with it.
///
/// Beyond 1e5 eps |f|, f may have jumped between the two times or states; or it is what is left of large terms, as of a
/// controlled system that comes to rest. Then (1) is the least of three differences: over the rounding, over one to the
/// other side, and from one rounding away to two. A jump is in two of them at most.
template <class S>
class rounding_floor {
 public:
  /// Whether errors of at most 1 are what they seem.
  bool is_below() const { return size_ == S(0); }
  /// The norm of (1), where errors are more than they seem.
  const S& size() const { return size_; }
  /// How many times the tolerances an error of a try is compared with. reach: h c; `tries`: until now; slope():
  /// the norm of f; rounding(i, j): that of f j roundings away less f i of them away, an evaluation for each that is
  /// not 0, asked for after rejections, and seldom.
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

  S size_{0};                 ///< the norm of (1) where it matters
  long long measured_ = -64;  ///< tries until it was measured
  int patience_ = 64;         ///< tries until a rejection makes it measured again
};

/// How far a k-th difference of numbers is off that are each off by something else of size 1:
///
///   sqrt(sum_j binomial(k, j)^2) = sqrt(binomial(2 k, k))          (2)
inline double rounding_of_difference(int k) {
  double square = 1;
  for (int j = 1; j <= k; ++j) square *= static_cast<double>(k + j) / j;
  return std::sqrt(square);
}

}  // namespace kte::detail
