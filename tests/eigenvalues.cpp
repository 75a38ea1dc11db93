#include "eigenvalues.hpp"

#include <Eigen/Eigenvalues>

Eigen::VectorXd kte::test::eigenvalues_of(const Eigen::MatrixXd& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly).eigenvalues();
}
