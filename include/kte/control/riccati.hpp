#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/errors.hpp>

#include <Eigen/Core>

namespace kte {

/// The stabilising solution X, symmetric, of the algebraic Riccati equation in continuous time,
///
///   A'X + X A - (X B + N) R^-1 (B'X + N') + Q = 0          (1)
///
/// for which A - B K with K = R^-1 (B'X + N') has eigenvalues with negative real parts only. A: n x n, B: n x m,
/// Q = Q': n x n, R = R' > 0: m x m, N: n x m, or left out, for 0. From the n decaying Schur vectors (U1; U2) of the
/// Hamiltonian matrix, X = U2 U1^-1 (Laub, IEEE Trans. Automatic Control 24, 1979), of a balanced problem; then steps
/// of Newton and Kleinman while they make the residual smaller.
///
/// Throws `bad_argument` for sizes that do not fit, numbers that are not finite, Q or R not symmetric, R not positive
/// definite; `no_solution` where (A, B) is not stabilisable, with the mode, and where the Hamiltonian matrix has
/// eigenvalues on the imaginary axis, as by a mode that neither decays nor counts in Q.
Eigen::MatrixXd care(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                     const Eigen::MatrixXd& R, const Eigen::MatrixXd& N = {});

/// The same in discrete time,
///
///   X = A'X A - (A'X B + N) (R + B'X B)^-1 (B'X A + N') + Q          (2)
///
/// for which A - B K with K = (R + B'X B)^-1 (B'X A + N') has eigenvalues within the unit circle only. By structured
/// doubling (Chu, Fan, Lin and Wang, Int. J. Control 77, 2004), also where A is singular. Throws as `care`.
Eigen::MatrixXd dare(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                     const Eigen::MatrixXd& R, const Eigen::MatrixXd& N = {});

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/control/detail/riccati.hpp>

namespace kte {
KTE_FUNCTION Eigen::MatrixXd care(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                  const Eigen::MatrixXd& R, const Eigen::MatrixXd& N) {
  return detail::solve_continuous(detail::riccati_problem("care", A, B, Q, R, N));
}
KTE_FUNCTION Eigen::MatrixXd dare(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                  const Eigen::MatrixXd& R, const Eigen::MatrixXd& N) {
  return detail::solve_discrete(detail::riccati_problem("dare", A, B, Q, R, N));
}
}  // namespace kte
#endif
