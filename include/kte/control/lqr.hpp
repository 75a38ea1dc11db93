#pragma once

#include <kte/control/linear_system.hpp>
#include <kte/control/riccati.hpp>

namespace kte {

/// A linear feedback, its cost and the poles of the closed loop.
struct lqr_gain {
  Eigen::MatrixXd K;       ///< u = u0 - K d
  Eigen::MatrixXd X;       ///< the cost from the state d on is d' X d
  Eigen::VectorXcd poles;  ///< eigenvalues of A - B K, 1/s; dimensionless in discrete time
};

/// The linear quadratic regulator: the feedback u = -K d of d' = A d + B u with the least cost
///
///   integral of d' Q d + 2 d' N u + u' R u,   K = R^-1 (B'X + N'),   X of `care`          (1)
///
///   const auto gain = kte::lqr(kte::linearize(model, x0, u0), Q, R);   // u = u0 - gain.K * (x - x0)
///
/// N (n x m) may be omitted, for 0. Throws as `care`; also `bad_argument` if Q - N R^-1 N' is not positive
/// semidefinite, so that the cost has no minimum.
[[nodiscard]] lqr_gain lqr(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                           const Eigen::MatrixXd& R, const Eigen::MatrixXd& N = {});
/// The linear quadratic regulator in discrete time, for d_(k+1) = A d_k + B u_k:
///
///   sum of d' Q d + 2 d' N u + u' R u,   K = (R + B'X B)^-1 (B'X A + N'),   X of `dare`
[[nodiscard]] lqr_gain dlqr(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                            const Eigen::MatrixXd& R, const Eigen::MatrixXd& N = {});

/// The linear quadratic regulator of a linear system. x_dot, which is nonzero if x0 is not an equilibrium, is ignored.
[[nodiscard]] inline lqr_gain lqr(const linear_system<>& s, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                  const Eigen::MatrixXd& N = {}) {
  return lqr(s.A, s.B, Q, R, N);
}
[[nodiscard]] inline lqr_gain lqr(const discrete_linear_system<>& s, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                  const Eigen::MatrixXd& N = {}) {
  return dlqr(s.A, s.B, Q, R, N);
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {
namespace detail {
/// The gain at X. Arguments: the matrix of the terms quadratic in u, factorized, and B'X or B'X A, to which N' is
/// added.
inline lqr_gain gain_at(const Eigen::MatrixXd& x, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                        const Eigen::MatrixXd& twice, Eigen::MatrixXd once, const Eigen::MatrixXd& N) {
  if (N.size() != 0) once += N.transpose();
  const Eigen::MatrixXd K = symmetric_part(twice).llt().solve(once);
  return {K, x, eigenvalues_of(A - B * K)};
}
}  // namespace detail
KTE_FUNCTION lqr_gain lqr(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                          const Eigen::MatrixXd& R, const Eigen::MatrixXd& N) {
  const detail::riccati_problem p("lqr", A, B, Q, R, N, true);
  const Eigen::MatrixXd x = detail::solve_continuous(p);
  return detail::gain_at(x, A, B, R, B.transpose() * x, N);
}
KTE_FUNCTION lqr_gain dlqr(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& Q,
                           const Eigen::MatrixXd& R, const Eigen::MatrixXd& N) {
  const detail::riccati_problem p("dlqr", A, B, Q, R, N, true);
  const Eigen::MatrixXd x = detail::solve_discrete(p);
  return detail::gain_at(x, A, B, R + B.transpose() * x * B, B.transpose() * x * A, N);
}
}  // namespace kte
#endif
