#pragma once

#include <Eigen/Core>

namespace kte::detail {

/// The backward differences of states x_n, x_{n-1}, ... a step h apart:
///
///   D^0 x_n = x_n,   D^{j+1} x_n = D^j x_n - D^j x_{n-1}                                      (1)
///   x(t_n + s h) = sum_{j=0}^k b_j(s) D^j x_n,   b_j(s) = s (s + 1) ... (s + j - 1) / j!      (2)
///
/// (2) is the polynomial of degree k through k + 1 states. With a step r h, the same polynomial has the differences
///
///   D^i <- sum_{j=1}^k D^j sum_{m=1}^i b_j(-m r) b_m(-i),   b_m(-i) = (-1)^m binomial(i, m)                 (3)
///
/// Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997), section 2, where (3) is D R(r) U.
///
/// N: the size of a state, or Eigen::Dynamic.
template <class S, int N>
class backward_differences {
 public:
  static constexpr int most = 5;  ///< degree of the polynomial

  /// Starts with the line through x with this slope times the step.
  template <class X, class D>
  void start(const X& x, const D& difference) {
    columns_.setZero(x.size(), most + 3);
    columns_.col(0) = x;
    columns_.col(1) = difference;
  }
  /// D^j.
  auto operator[](int j) const { return columns_.col(j); }

  /// sum_{j=1}^k weight(j) D^j
  template <class Weight, class X>
  void combine(int k, const Weight& weight, X& out) const {
    out = weight(1) * columns_.col(1);
    for (int j = 2; j <= k; ++j) out += weight(j) * columns_.col(j);
  }
  /// (2) at s = 1: the next state, if D^{k+1} of it is zero.
  template <class X>
  void predict(int k, X& out) const {
    out = columns_.col(0);
    for (int j = 1; j <= k; ++j) out += columns_.col(j);
  }
  /// (2) at s = theta - 1, from x_{n-1}: exact as theta goes to 0.
  template <class X, class Before>
  void interpolate(int k, const S& theta, const Before& before, X& out) const {
    S b = theta;
    out = before + theta * columns_.col(1);
    for (int j = 2; j <= k; ++j) {
      b *= (theta + S(j == 2 ? -1 : j - 2)) / S(j);
      out += b * columns_.col(j);
    }
  }
  /// The next state differs by d from its prediction (2); d is then its D^{k+1}. Also computes D^{k+2} if k and h are
  /// those of the previous call.
  template <class X>
  void add(int k, const X& d) {
    columns_.col(k + 2) = d - columns_.col(k + 1);
    columns_.col(k + 1) = d;
    for (int j = k; j >= 0; --j) columns_.col(j) += columns_.col(j + 1);
  }
  /// Sets D^0, which differs by rounding errors.
  template <class X>
  void replace(const X& x) {
    columns_.col(0) = x;
  }
  /// (3): the polynomial of degree k with steps r h.
  void rescale(int k, const S& r) {
    const square change = changes(k, r);
    for (Eigen::Index i = 0; i < columns_.rows(); ++i) {
      auto row = columns_.row(i).segment(1, k);
      const Eigen::Matrix<S, 1, Eigen::Dynamic, Eigen::RowMajor, 1, most> old = row;
      row.noalias() = old.lazyProduct(change);
    }
  }

 private:
  using square = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  /// The matrix R(r) U of (3), row j, column i.
  static square changes(int k, const S& r) { return values(k, r).lazyProduct(values(k, S(1))); }
  /// b_j(-m r), row j, column m, from 1.
  static square values(int k, const S& r) {
    square b(k, k);
    for (int m = 1; m <= k; ++m) {
      S value(1);
      for (int j = 1; j <= k; ++j) {
        value *= (S(j - 1) - S(m) * r) / S(j);
        b(j - 1, m - 1) = value;
      }
    }
    return b;
  }

  Eigen::Matrix<S, N, most + 3> columns_;
};

}  // namespace kte::detail
