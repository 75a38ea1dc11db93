#pragma once

#include <kte/detail/compiled.hpp>

#include <Eigen/Core>

#include <limits>
#include <memory>

#ifdef KTE_FUNCTION
#  include <Eigen/Eigenvalues>

#  include <cmath>
#endif

namespace kte::detail {

/// The fastest weakly damped oscillation of x' = J x: the largest |lambda|, rad/s, of the eigenvalues with
///
///   |Im lambda| > 10 |Re lambda|,   |lambda| > sqrt(eps) |J|          (1)
///
/// Smaller eigenvalues may be rounding errors, also of a Jacobian by differences. In double for all scalars, because
/// Eigen's real Schur form takes long to compile: a step is only compared with the result.
class weakly_damped {
 public:
  /// For n components.
  explicit weakly_damped(Eigen::Index n);
  weakly_damped(const weakly_damped& other);
  weakly_damped& operator=(const weakly_damped& other);
  weakly_damped(weakly_damped&&) noexcept;
  weakly_damped& operator=(weakly_damped&&) noexcept;
  ~weakly_damped();

  /// The result of (1) with eps of the scalar of J; 0 if there is none. Allocates nothing.
  template <class Matrix>
  typename Matrix::Scalar fastest(const Matrix& j) {
    using S = typename Matrix::Scalar;
    for (Eigen::Index column = 0; column < j.cols(); ++column)
      for (Eigen::Index row = 0; row < j.rows(); ++row) j_(row, column) = static_cast<double>(j(row, column));
    return static_cast<S>(fastest_above(static_cast<double>(std::numeric_limits<S>::epsilon())));
  }

 private:
  struct schur_form;
  double fastest_above(double epsilon);

  Eigen::MatrixXd j_;
  std::unique_ptr<schur_form> schur_;
};

#ifdef KTE_FUNCTION
struct weakly_damped::schur_form : Eigen::RealSchur<Eigen::MatrixXd> {
  using Eigen::RealSchur<Eigen::MatrixXd>::RealSchur;
};

KTE_FUNCTION weakly_damped::weakly_damped(Eigen::Index n) : j_(n, n), schur_(std::make_unique<schur_form>(n)) {}
KTE_FUNCTION weakly_damped::weakly_damped(const weakly_damped& other) : weakly_damped(other.j_.rows()) {}
KTE_FUNCTION weakly_damped& weakly_damped::operator=(const weakly_damped& other) {
  return *this = weakly_damped(other.j_.rows());
}
KTE_FUNCTION weakly_damped::weakly_damped(weakly_damped&&) noexcept = default;
KTE_FUNCTION weakly_damped& weakly_damped::operator=(weakly_damped&&) noexcept = default;
KTE_FUNCTION weakly_damped::~weakly_damped() = default;

KTE_FUNCTION double weakly_damped::fastest_above(double epsilon) {
  double most = 0;
  if (j_.rows() < 2 || schur_->compute(j_, false).info() != Eigen::Success) return most;
  const Eigen::MatrixXd& t = schur_->matrixT();
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
#endif

}  // namespace kte::detail
