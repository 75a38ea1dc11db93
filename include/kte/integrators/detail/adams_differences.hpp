#pragma once

#include <kte/integrators/detail/gauss_rule.hpp>

#include <array>
#include <type_traits>

namespace kte::detail {

/// The history of an Adams method: slopes f_0 (the newest), f_1, ... at the times t_0, t_1, ... with any spacing, as
/// modified divided differences:
///
///   phi_0 = f_0,   phi_j = (t_0 - t_1) ... (t_0 - t_j) f[t_0, ..., t_j]                              (1)
///
/// The polynomial P through the k newest slopes, at a time t = t_0 + h, and its mean from t_0 to t:
///
///   P(t) = sum_{j<k} beta_j phi_j,   beta_0 = 1,   beta_j = beta_{j-1} (t - t_{j-1}) / (t_0 - t_j)   (2)
///   mean = sum_{j<k} g_j beta_j phi_j                                                               (3)
///   g_j = int_0^1 prod_{i<j} (1 - u h / (t - t_i)) du                                               (4)
///
/// After adding the slope f at t to the history, its differences are
///
///   phi'_0 = f,   phi'_{j+1} = phi'_j - beta_j phi_j                                                (5)
///
/// The mean of P over a time s from t_1 is
///
///   sum_{j<k} phi_j int_0^1 prod_{i<j} (t_1 + s u - t_i) / (t_0 - t_{i+1}) du                       (6)
///
/// Vectors are padded with zeros to blocks of `width` numbers, so that long sums are computed in registers.
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, III.5; Shampine and Gordon, Computer
/// Solution of Ordinary Differential Equations, 1975, chapter 5.
template <class X>
class adams_differences {
 public:
  using S = typename X::Scalar;
  static constexpr int most = 13;  ///< slopes: those of the polynomial of order 13

  explicit adams_differences(const X& zero)
      : size_(zero.size()), slope_(column::Zero(padded(size_))), mean_(slope_), offered_(slope_) {
    phi_.fill(slope_);
    inverse_since_.setZero();
    inverse_span_.setZero();
  }

  /// The first slope.
  void start(const S& t, const X& f) {
    known_ = 1;
    times_.fill(t);
    of_state(phi_[0]) = f;
  }
  /// Forgets all slopes but the newest.
  void forget() { known_ = 1; }
  /// The number of known slopes.
  int known() const { return known_; }
  auto newest() const { return difference(0); }
  /// phi_j of (1), for j < known().
  auto difference(int j) const { return of_state(phi_[at(j)]); }
  /// g_j and beta_j of the step prepared by `aim`, for j <= k + 1 and j <= k, and below known() + 1 and known().
  const S& g(int j) const { return g_[j]; }
  const S& beta(int j) const { return beta_[j]; }
  /// (2) and (3) for this step.
  auto slope() const { return of_state(slope_); }
  auto mean() const { return of_state(mean_); }

  /// Prepares a step to t by a prediction with k slopes: (2), (3), (4). Slopes beyond the needs of order k + 1 are
  /// dropped.
  void aim(const S& t, int k) {
    if (known_ > k + 1) known_ = k + 1;
    const coefficients since = t - times_, growth = since * inverse_span_;
    inverse_since_ = since.inverse();
    const coefficients ratios = S(-since[0]) * inverse_since_;
    coefficients of_mean;
    S beta(1);
    rule_.average_products(
        known_, [](int) { return S(1); }, [&](int i) { return ratios[i]; },
        [&](int j, const S& g) {
          g_[j] = g;
          beta_[j] = beta;
          of_mean[j] = g * beta;
          beta *= growth[j];
        });
    for (Eigen::Index r = 0; r < slope_.size(); r += width) {
      block p = block::Zero(), m = block::Zero();
      for (int j = k - 1; j >= 0; --j) {  // small terms first
        const block d = block_of(phi_[at(j)], r);
        p += beta_[j] * d;
        m += of_mean[j] * d;
      }
      block_of(slope_, r) = p;
      block_of(mean_, r) = m;
    }
  }
  /// Stores the slope f at the time of `aim`, for `append`. Call it early, because processors wait if they read in wide
  /// registers what was just written in narrow ones.
  void offer(const X& f) { of_state(offered_) = f; }
  /// Appends the slope of `offer`, at the time of `aim`: (5).
  void append(const S& t) {
    const int kept = known_ < most ? known_ : most - 1;
    for (Eigen::Index r = 0; r < slope_.size(); r += width) {
      block next = block_of(offered_, r);
      for (int j = 0; j < kept; ++j) {
        const block d = block_of(phi_[at(j)], r);
        block_of(phi_[at(j)], r) = next;
        next -= beta_[j] * d;
      }
      block_of(phi_[at(kept)], r) = next;
    }
    times_.template tail<15>() = times_.template head<15>().eval();
    inverse_span_ = inverse_since_;
    times_[0] = t;
    known_ = kept + 1;
  }
  /// mean = (6) with k slopes, for the last step. Exact as s goes to 0.
  void interpolate(const S& s, int k, X& mean) const {
    mean.setZero();
    rule_.average_products(
        k - 1, [&](int i) { return S((times_[1] - times_[i]) * inverse_span_[i]); },
        [&](int i) { return S(s * inverse_span_[i]); }, [&](int j, const S& c) { mean += c * difference(j); });
  }

 private:
  static constexpr int rows = X::RowsAtCompileTime;
  static constexpr bool packed = std::is_same_v<S, double> || std::is_same_v<S, float>;
  static constexpr int widest = EIGEN_MAX_STATIC_ALIGN_BYTES < 32 ? 8 : 16;  // all in registers
  /// `count` numbers by blocks of equal width, of whole packets.
  static constexpr int width_for(int count) {
    const int blocks = (count + widest - 1) / widest, each = (count + blocks - 1) / blocks;
    return each <= 2 ? each : (each + 3) / 4 * 4;
  }
  static constexpr int width = !packed ? 1 : width_for(rows == Eigen::Dynamic ? 8 : rows);
  static constexpr Eigen::Index padded(Eigen::Index n) { return (n + width - 1) / width * width; }
  static constexpr int padded_rows = rows == Eigen::Dynamic ? Eigen::Dynamic : static_cast<int>(padded(rows));
  using column = Eigen::Matrix<S, padded_rows, 1>;
  using block = Eigen::Array<S, width, 1>;
  /// One number per slope, padded. Times of unknown slopes are chosen earlier, so that no division is by zero.
  using coefficients = Eigen::Array<S, 16, 1>;

  static std::size_t at(int j) { return static_cast<std::size_t>(j); }
  template <class V>
  auto of_state(V&& padded) const {
    return padded.template head<rows>(size_);
  }
  template <class V>
  static auto block_of(V&& padded, Eigen::Index r) {
    return padded.template segment<width>(r).array();
  }

  gauss_rule<S> rule_;
  Eigen::Index size_;
  int known_ = 0;
  std::array<column, most> phi_;
  column slope_, mean_, offered_;
  coefficients times_, beta_, g_;
  coefficients inverse_since_, inverse_span_;  ///< 1 / (t - t_j), 1 / (t_0 - t_{j+1})
};

}  // namespace kte::detail
