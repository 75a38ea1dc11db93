#pragma once

#include <kte/detail/compiled.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace kte::detail {

/// The fastest weakly damped oscillation of x' = J x: the largest |lambda|, rad/s, of the eigenvalues with
///
///   |Im lambda| > 10 |Re lambda|,   |lambda| > sqrt(eps) |J|          (1)
///
/// Smaller eigenvalues may be rounding errors, also of a Jacobian by differences. In double for all scalars, because
/// Eigen's real Schur form takes long to compile: a step is only compared with the result. `Most` components, which
/// need no heap, or Eigen::Dynamic.
template <int Most>
class weakly_damped {
 public:
  /// For n components.
  explicit weakly_damped(Eigen::Index n) : j_(n, n), schur_(n) {}

  /// The result of (1) with eps of the scalar of J; 0 if there is none.
  template <class Matrix>
  typename Matrix::Scalar fastest(const Matrix& j) {
    using S = typename Matrix::Scalar;
    for (Eigen::Index column = 0; column < j.cols(); ++column)
      for (Eigen::Index row = 0; row < j.rows(); ++row) j_(row, column) = static_cast<double>(j(row, column));
    return static_cast<S>(fastest_above(static_cast<double>(std::numeric_limits<S>::epsilon())));
  }

 private:
  double fastest_above(double epsilon);

  using matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Most, Most>;
  matrix j_;
  Eigen::RealSchur<matrix> schur_;
};

template <int Most>
double weakly_damped<Most>::fastest_above(double epsilon) {
  double most = 0;
  if (j_.rows() < 2 || schur_.compute(j_, false).info() != Eigen::Success) return most;
  const matrix& t = schur_.matrixT();
  const double least = std::sqrt(epsilon) * j_.norm();
  for (Eigen::Index i = 0; i + 1 < t.rows(); ++i) {
    const double half = (t(i, i) - t(i + 1, i + 1)) / 2, square = -(half * half + t(i, i + 1) * t(i + 1, i));
    if (t(i + 1, i) == 0 || !(square > 0)) continue;  // of a block of two rows, (Im lambda)^2
    const double real = (t(i, i) + t(i + 1, i + 1)) / 2, imaginary = std::sqrt(square);
    const double size = std::hypot(real, imaginary);
    if (imaginary > 10 * std::abs(real) && size > least && most < size) most = size;
  }
  return most;
}

/// For vectors of N components: one class for up to 16.
template <int N>
using weakly_damped_for = weakly_damped<(N == Eigen::Dynamic || N > 16) ? N : 16>;

#if defined(KTE_EXTERN)
KTE_EXTERN template double weakly_damped<16>::fastest_above(double);
KTE_EXTERN template double weakly_damped<Eigen::Dynamic>::fastest_above(double);
#endif

}  // namespace kte::detail
