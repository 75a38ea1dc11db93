#pragma once

#include <Eigen/Core>

namespace kte::test {

/// The eigenvalues of a symmetric matrix, the smallest first. Compiled once (eigenvalues.cpp): Eigen's solver takes two
/// seconds.
Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& m);

}  // namespace kte::test
