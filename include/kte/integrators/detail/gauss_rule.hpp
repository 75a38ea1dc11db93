#pragma once

#include <Eigen/Core>

#include <array>

namespace kte::detail {

/// The mean of a polynomial over 0 < u < 1 by the Gauss-Legendre rule with n = 8 nodes, exact to degree 15:
///
///   int_0^1 p(u) du = sum_m w_m p(u_m),   u_m = (1 + z_m) / 2,   w_m = 1 / ((1 - z_m^2) P_n'(z_m)^2)          (1)
///
/// with the zeros z_m of Legendre's polynomial P_n. All weights are positive.
template <class S>
class gauss_rule {
  using half = Eigen::Array<S, 4, 1>;

 public:
  static constexpr int nodes = 8;

  gauss_rule() {
    constexpr std::array zeros{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    for (int m = 0; m < nodes / 2; ++m) {
      S z = static_cast<S>(zeros[static_cast<std::size_t>(m)]), slope;
      for (int i = 0; i < 3; ++i) z -= legendre(z, slope) / slope;  // Newton's method, to 100 digits
      legendre(z, slope);
      left_[m] = (1 - z) / 2, right_[m] = (1 + z) / 2;
      weights_[m] = 1 / ((1 - z * z) * slope * slope);
    }
  }

  /// Calls take(j, m) with the mean m of the product of the first j factors a(i) + b(i) u, for j = 0, ..., last.
  template <class A, class B, class Take>
  void average_products(int last, const A& a, const B& b, const Take& take) const {
    half left = weights_, right = weights_;
    take(0, S(1));
    for (int j = 1; j <= last; ++j) {
      left *= a(j - 1) + b(j - 1) * left_;
      right *= a(j - 1) + b(j - 1) * right_;
      take(j, S((left + right).sum()));
    }
  }

 private:
  /// P_n(z) and its derivative.
  static S legendre(const S& z, S& slope) {
    S before(1), p(z);
    for (int i = 2; i <= nodes; ++i) {
      const S next = z * p + S(i - 1) / S(i) * (z * p - before);
      before = p, p = next;
    }
    slope = S(nodes) * (z * p - before) / (z * z - 1);
    return p;
  }

  half left_, right_, weights_;  ///< for the nodes below and above 1/2
};

}  // namespace kte::detail
