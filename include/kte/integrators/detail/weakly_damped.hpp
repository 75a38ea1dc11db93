#pragma once

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>
#include <type_traits>

namespace kte::detail {

/// The fastest weakly damped oscillation of x' = J x: the largest |lambda|, rad/s, of the eigenvalues with
///
///   |Im lambda| > 10 |Re lambda|,   |lambda| > sqrt(eps) |J|          (1)
///
/// Returns 0 if there is none. Smaller eigenvalues may be rounding errors, also of a Jacobian by differences. Returns 0
/// for scalars other than machine types.
template <class Matrix, bool Known = std::is_floating_point_v<typename Matrix::Scalar>>
class weakly_damped {
  using S = typename Matrix::Scalar;

 public:
  /// For n components.
  explicit weakly_damped(Eigen::Index n) : schur_(n) {}

  S fastest(const Matrix& j) {
    S most(0);
    if (j.rows() < 2 || schur_.compute(j, false).info() != Eigen::Success) return most;
    const auto& t = schur_.matrixT();
    const S least = std::sqrt(std::numeric_limits<S>::epsilon()) * j.norm();
    for (Eigen::Index i = 0; i + 1 < t.rows(); ++i) {
      const S half = (t(i, i) - t(i + 1, i + 1)) / 2, square = -(half * half + t(i, i + 1) * t(i + 1, i));
      if (t(i + 1, i) == S(0) || !(square > S(0))) continue;  // of a block of two rows, (Im lambda)^2
      const S real = (t(i, i) + t(i + 1, i + 1)) / 2, imaginary = std::sqrt(square), size = std::hypot(real, imaginary);
      if (imaginary > 10 * std::abs(real) && size > least && most < size) most = size;
    }
    return most;
  }

 private:
  Eigen::RealSchur<Matrix> schur_;
};
template <class Matrix>
class weakly_damped<Matrix, false> {
 public:
  explicit weakly_damped(Eigen::Index) {}
  static typename Matrix::Scalar fastest(const Matrix&) { return typename Matrix::Scalar(0); }
};

}  // namespace kte::detail
