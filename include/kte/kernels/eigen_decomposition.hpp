#pragma once

#include <kte/detail/compiled.hpp>

#include <Eigen/Core>

#ifdef KTE_FUNCTION
#  include <Eigen/Eigenvalues>
#endif

namespace kte::detail {

/// Eigenvalues of a square matrix, and eigenvectors of length 1 in columns.
struct eigen_decomposition {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  ///< empty if not asked for
};
/// By Eigen's general solver, which takes long to compile: once here.
eigen_decomposition eigen_decomposition_of(const Eigen::MatrixXd& m, bool with_vectors);

#ifdef KTE_FUNCTION
KTE_FUNCTION eigen_decomposition eigen_decomposition_of(const Eigen::MatrixXd& m, bool with_vectors) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(m, with_vectors);
  eigen_decomposition r{solver.eigenvalues(), {}};
  if (with_vectors) r.vectors = solver.eigenvectors();
  return r;
}
#endif

}  // namespace kte::detail
