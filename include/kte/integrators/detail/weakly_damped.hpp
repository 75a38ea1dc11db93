#pragma once

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <type_traits>

namespace kte::detail {

/// The fastest oscillation of x' = J x that is hardly damped: the largest |lambda|, rad/s, of the eigenvalues with
///
///   |Im lambda| > 10 |Re lambda|,   |lambda| > sqrt(eps) |J|          (1)
///
/// 0 if there are none. Smaller ones may be rounding, also that of a Jacobian by differences. For other scalars than
/// those of the machine 0, too.
template <class Matrix>
typename Matrix::Scalar fastest_weakly_damped(const Matrix& j) {
  using S = typename Matrix::Scalar;
  S most(0);
  if constexpr (std::is_floating_point_v<S>) {
    if (j.rows() < 2) return most;
    const Eigen::RealSchur<Matrix> schur(j, false);
    if (schur.info() != Eigen::Success) return most;
    const auto& t = schur.matrixT();
    const S least = std::sqrt(std::numeric_limits<S>::epsilon()) * j.norm();
    for (Eigen::Index i = 0; i + 1 < t.rows(); ++i) {
      const S half = (t(i, i) - t(i + 1, i + 1)) / 2, square = -(half * half + t(i, i + 1) * t(i + 1, i));
      if (t(i + 1, i) == S(0) || !(square > S(0))) continue;  // of a block of two rows, (Im lambda)^2
      const S real = (t(i, i) + t(i + 1, i + 1)) / 2, imaginary = std::sqrt(square), size = std::hypot(real, imaginary);
      if (imaginary > 10 * std::abs(real) && size > least && most < size) most = size;
    }
  }
  return most;
}

}  // namespace kte::detail
