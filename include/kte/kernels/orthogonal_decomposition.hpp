#pragma once

#include <kte/detail/compiled.hpp>

#include <Eigen/QR>

namespace kte::detail {

/// Least-squares solutions of least norm of linear equations A x = b, by Eigen's complete orthogonal decomposition,
/// which takes long to compile: once here.
class orthogonal_decomposition {
 public:
  /// `threshold`: of pivots, relative to the largest; zero: Eigen's.
  void compute(const Eigen::MatrixXd& a, double threshold = 0);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors_;
};

#ifdef KTE_FUNCTION
KTE_FUNCTION void orthogonal_decomposition::compute(const Eigen::MatrixXd& a, double threshold) {
  if (threshold > 0) factors_.setThreshold(threshold);
  factors_.compute(a);
}
KTE_FUNCTION Eigen::MatrixXd orthogonal_decomposition::solve(const Eigen::MatrixXd& b) const {
  return factors_.solve(b);
}
#endif

}  // namespace kte::detail
