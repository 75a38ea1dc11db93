#pragma once

#include <Eigen/LU>

#include <array>
#include <complex>

#include "digits50.hpp"

/// Order conditions up to 4 and the stability of implicit methods, Runge-Kutta and Rosenbrock. With A the weights of
/// slopes in stages, B = A + Gamma for Rosenbrock methods and B = A for others, c = A 1:
///
///   (1) b 1 = theta;  b B 1 = theta^2/2;  b c^2 = theta^3/3, b B B 1 = theta^3/6;
///       b c^3 = theta^4/4, b (c A B 1) = theta^4/8, b B c^2 = theta^4/12, b B B B 1 = theta^4/24
///   (2) R(z) = 1 + z b (I - z B)^-1 1
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.7, table 7.1 and (7.14).
namespace kte::test {

using real50 = digits50;

template <std::size_t Stages>
struct implicit_method {
  static constexpr int n = static_cast<int>(Stages);
  using matrix = Eigen::Matrix<real50, n, n>;
  using vector = Eigen::Matrix<real50, n, 1>;
  matrix A, B;

  /// The largest difference in the conditions (1) of an order.
  real50 defect(const vector& b, int order, const real50& theta = 1) const {
    const vector one = vector::Ones(), c = A * one, c2 = c.cwiseProduct(c), Bone = B * one;
    const real50 t2 = theta * theta, t3 = t2 * theta, t4 = t3 * theta;
    const auto differs = [&](const vector& phi, const real50& value) -> real50 { return abs(b.dot(phi) - value); };
    const auto most = [](const real50& x, const real50& y) { return x < y ? y : x; };
    if (order == 1) return differs(one, theta);
    if (order == 2) return differs(Bone, t2 / 2);
    if (order == 3) return most(differs(c2, t3 / 3), differs(B * Bone, t3 / 6));
    return most(most(differs(c2.cwiseProduct(c), t4 / 4), differs(c.cwiseProduct(A * Bone), t4 / 8)),
                most(differs(B * c2, t4 / 12), differs(B * (B * Bone), t4 / 24)));
  }
  /// (2)
  std::complex<double> growth(const vector& b, const std::complex<double>& z) const {
    using complex_matrix = Eigen::Matrix<std::complex<double>, n, n>;
    using complex_vector = Eigen::Matrix<std::complex<double>, n, 1>;
    const complex_matrix W = complex_matrix::Identity() - z * B.template cast<double>();
    const complex_vector k = W.partialPivLu().solve(complex_vector::Ones());
    return 1.0 + z * b.template cast<double>().template cast<std::complex<double>>().dot(k);
  }
};

template <std::size_t N>
auto vector_of(const std::array<real50, N>& v) {
  Eigen::Matrix<real50, static_cast<int>(N), 1> r;
  for (std::size_t i = 0; i < N; ++i) r[static_cast<int>(i)] = v[i];
  return r;
}
template <std::size_t N>
auto matrix_of(const std::array<std::array<real50, N>, N>& rows) {
  Eigen::Matrix<real50, static_cast<int>(N), static_cast<int>(N)> r;
  for (std::size_t i = 0; i < N; ++i) r.row(static_cast<int>(i)) = vector_of(rows[i]).transpose();
  return r;
}

}  // namespace kte::test
