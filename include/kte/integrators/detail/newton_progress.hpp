#pragma once

#include <kte/integrators/time_grid.hpp>

namespace kte::detail {

/// What to do after a correction.
enum class newton { go_on, converged, hopeless };

/// Judges simplified Newton iterations by the sizes of their corrections, |d_1|, |d_2|, ...:
///
///   rate = |d_i| / |d_{i-1}|,   remaining error after correction i:  rate / (1 - rate) |d_i|      (1)
///   remaining error after the last allowed correction m:  rate^(m - i) times as much               (2)
///
/// The rate is remembered while the matrix is unchanged (see `forget`), so that a single correction may be enough.
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.8; Shampine and Reichelt, The MATLAB ODE
/// Suite, SIAM J. Sci. Comput. 18 (1997), section 2.
template <class S>
class newton_progress {
 public:
  /// Call this when the matrix has changed.
  void forget() { rate_ = S(0); }
  /// Begins iterations that end when at most `tolerance` remains. Corrections below `rounding` cannot decrease further.
  void begin(const S& tolerance, const S& rounding) {
    tolerance_ = tolerance;
    rounding_ = rounding;
    corrections_ = 0;
  }
  /// Judges the next correction by its size.
  newton judge(const S& size) {
    ++corrections_;
    if (!is_finite(size)) return newton::hopeless;
    if (size <= rounding_) return newton::converged;
    if (corrections_ > 1) {
      const S seen = size / last_;
      if (seen >= S(0.9)) return newton::hopeless;
      rate_ = seen;
    }
    last_ = size;
    if (rate_ == S(0)) return newton::go_on;
    S left = rate_ / (1 - rate_) * size;  // (1)
    if (left <= tolerance_) return newton::converged;
    if (corrections_ == 1) return newton::go_on;              // the rate is that of another step
    for (int i = corrections_; i < most; ++i) left *= rate_;  // (2)
    return corrections_ == most || left > tolerance_ ? newton::hopeless : newton::go_on;
  }

 private:
  static constexpr int most = 4;

  S tolerance_{}, rounding_{};
  S rate_{0};  ///< 0: unknown
  S last_{};
  int corrections_ = 0;
};

}  // namespace kte::detail
