#pragma once

#include <kte/detail/compiled.hpp>
#include <kte/errors.hpp>

#include <Eigen/Core>

namespace kte {

/// The stabilizing symmetric solution X of the algebraic Riccati equation in continuous time,
///
///   A'X + X A - (X B + N) R^-1 (B'X + N') + Q = 0          (1)
///
/// for which all eigenvalues of A - B K, K = R^-1 (B'X + N'), have negative real parts. A: n x n, B: n x m, Q = Q': n x
/// n, R = R' > 0: m x m, N: n x m, or omitted, for 0. By a Cayley transform and structured doubling of a balanced
/// problem (Chu, Fan and Lin, Linear Algebra Appl. 396, 2005), followed by Newton-Kleinman steps while they reduce the
/// residual.
///
/// Throws `bad_argument` for sizes that do not fit, numbers that are not finite, Q or R not symmetric, R not positive
/// definite; `no_solution` if (A, B) is not stabilizable, naming the mode, and if the Hamiltonian matrix has
/// eigenvalues on the imaginary axis, as for an undamped mode without weight in Q.
[[nodiscard]] Eigen::MatrixXd care(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                                   const Eigen::MatrixXd& R, const Eigen::MatrixXd& N = {});

/// The stabilizing symmetric solution X of the algebraic Riccati equation in discrete time,
///
///   X = A'X A - (A'X B + N) (R + B'X B)^-1 (B'X A + N') + Q          (2)
///
/// for which all eigenvalues of A - B K, K = (R + B'X B)^-1 (B'X A + N'), are inside the unit circle. By structured
/// doubling (Chu, Fan, Lin and Wang, Int. J. Control 77, 2004), also for singular A. Throws what `care` throws.
[[nodiscard]] Eigen::MatrixXd dare(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
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
