#pragma once

#include <Eigen/Core>

#include <array>

namespace kte::detail {

/// What an Adams method knows of the past: slopes f_0 (the newest), f_1, ... at the times t_0, t_1, ... with any
/// spacing, kept as modified divided differences:
///
///   phi_0 = f_0,   phi_j = (t_0 - t_1) ... (t_0 - t_j) f[t_0, ..., t_j]                              (1)
///
/// The polynomial P through the k newest slopes, at a time t = t_0 + h, and its integral from t_0:
///
///   P(t) = sum_{j<k} beta_j phi_j,   beta_0 = 1,   beta_j = beta_{j-1} (t - t_{j-1}) / (t_0 - t_j)   (2)
///   int P = h sum_{j<k} g_j beta_j phi_j                                                            (3)
///   g_j = 1/h int_{t_0}^{t} (s - t_0) ... (s - t_{j-1}) / ((t - t_0) ... (t - t_{j-1})) ds           (4)
///
/// With the slope f at t in the history, its differences are
///
///   phi'_0 = f,   phi'_{j+1} = phi'_j - beta_j phi_j                                                (5)
///
/// The integrals (4), with d_j = t - t_{j-1}, and those times beta_j, with d_j = t_0 - t_j, from t - h to t, are
/// c_{j,0} of
///
///   c_{0,q} = 1 / (q + 1),   c_{j,q} = ((t - t_{j-1}) c_{j-1,q} - h c_{j-1,q+1}) / d_j               (6)
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, III.5; Shampine and Gordon, Computer
/// Solution of Ordinary Differential Equations, 1975, chapter 5.
template <class X>
class adams_differences {
 public:
  using S = typename X::Scalar;
  static constexpr int most = 13;  ///< slopes: those of the polynomial of order 13

  explicit adams_differences(const X& zero) : step_(zero) { phi_.fill(zero); }

  /// The first slope.
  void start(const S& t, const X& f) {
    known_ = 1;
    times_[0] = t;
    phi_[0] = f;
  }
  /// Forgets all slopes but the newest.
  void forget() { known_ = 1; }
  /// How many slopes are known.
  int known() const { return known_; }
  const X& newest() const { return phi_[0]; }
  /// phi_j of (1), for j < known().
  const X& difference(int j) const { return phi_[at(j)]; }
  /// g_j and beta_j of the step that was aimed at: j <= k + 1 and j <= known() for g, j < known() for beta.
  const S& g(int j) const { return g_[at(j)]; }
  const S& beta(int j) const { return beta_[at(j)]; }

  /// Prepares a step to t: (2) and (4), for predictions with k slopes.
  void aim(const S& t, int k) {
    const int last = k + 1 < known_ ? k + 1 : known_;
    const auto since = [&](int j) { return S(t - times_[at(j)]); };
    integrals(since(0), last, g_, since, [&](int j) { return since(j - 1); });
    beta_[0] = S(1);
    for (int j = 1; j < known_; ++j)
      beta_[at(j)] = beta_[at(j - 1)] * S((t - times_[at(j - 1)]) / (times_[0] - times_[at(j)]));
  }
  /// slope = P at the time aimed at, mean = int P / h, from k slopes: (2), (3).
  void extrapolate(int k, X& slope, X& mean) const {
    slope = beta_[at(k - 1)] * phi_[at(k - 1)];
    mean = g_[at(k - 1)] * slope;
    for (int j = k - 2; j >= 0; --j) {  // small ones first
      slope += beta_[at(j)] * phi_[at(j)];
      mean += (g_[at(j)] * beta_[at(j)]) * phi_[at(j)];
    }
  }
  /// Appends the slope f at the time aimed at: (5).
  void append(const S& t, const X& f) {
    const int kept = known_ < most ? known_ : most - 1;
    step_ = f;
    for (int j = 0; j < kept; ++j) {
      phi_[at(j)].swap(step_);
      step_ = phi_[at(j)] - beta_[at(j)] * step_;
    }
    phi_[at(kept)] = step_;
    for (int j = kept; j > 0; --j) times_[at(j)] = times_[at(j - 1)];
    times_[0] = t;
    known_ = kept + 1;
  }
  /// mean = int P / s over a time s from the start t_1 of the last step, from k slopes. Exact as s goes to 0.
  void interpolate(const S& s, int k, X& mean) const {
    coefficients products{};
    integrals(
        s, k - 1, products, [&](int j) { return S(s + (times_[1] - times_[at(j)])); },
        [&](int j) { return S(times_[0] - times_[at(j)]); });
    mean = products[at(k - 1)] * phi_[at(k - 1)];
    for (int j = k - 2; j >= 0; --j) mean += products[at(j)] * phi_[at(j)];
  }

 private:
  using coefficients = std::array<S, most + 1>;
  static std::size_t at(int j) { return static_cast<std::size_t>(j); }

  /// (6) for j = 0 ... last. since(j): t - t_j.
  template <class Since, class Divisor>
  void integrals(const S& h, int last, coefficients& out, const Since& since, const Divisor& divisor) const {
    coefficients c{};
    for (int q = 0; q <= last; ++q) c[at(q)] = 1 / S(q + 1);
    out[0] = S(1);
    for (int j = 1; j <= last; ++j) {
      const S one = 1 / divisor(j), a = since(j - 1) * one, b = h * one;
      for (int q = 0; q <= last - j; ++q) c[at(q)] = a * c[at(q)] - b * c[at(q + 1)];
      out[at(j)] = c[0];
    }
  }

  int known_ = 0;
  std::array<X, most> phi_;
  X step_;
  coefficients times_{}, beta_{}, g_{};
};

}  // namespace kte::detail
