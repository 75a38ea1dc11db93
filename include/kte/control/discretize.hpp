#pragma once

#include <kte/control/linear_system.hpp>
#include <kte/detail/compiled.hpp>
#include <kte/errors.hpp>

#ifdef KTE_FUNCTION
#  include <cmath>
#  include <unsupported/Eigen/MatrixFunctions>
#endif

namespace kte {

/// The discrete-time system with interval dt, s, and inputs constant within an interval (zero-order hold), exactly:
///
///       | A  B  x_dot |         | A_d  B_d  step |
///   exp | 0  0    0   | dt   =  |  0    1    0   |          (1)
///       | 0  0    0   |         |  0    0    1   |
///
/// by the matrix exponential of Eigen (scaling and squaring, Higham 2005). C, D and y0 are unchanged. Throws
/// `bad_argument` unless dt is finite and positive, if the result overflows, and if sizes do not fit.
[[nodiscard]] discrete_linear_system<> discretize(const linear_system<>& c, double dt);

#ifdef KTE_FUNCTION
KTE_FUNCTION discrete_linear_system<> discretize(const linear_system<>& c, double dt) {
  if (!(dt > 0 && std::isfinite(dt)))
    detail::raise<bad_argument>("kte: discretize: dt must be finite and positive, got " + detail::number(dt));
  const Eigen::Index n = c.A.rows(), m = c.B.cols();
  if (c.A.cols() != n || c.B.rows() != n || c.x_dot.size() != n)
    detail::raise<bad_argument>("kte: discretize: A must be square, with as many rows as B and x_dot");
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + m + 1, n + m + 1);
  all.topRows(n) << c.A * dt, c.B * dt, c.x_dot * dt;
  if (!all.allFinite())
    detail::raise<bad_argument>("kte: discretize: a number of A, B or x_dot, times dt, is not finite");
  const Eigen::MatrixXd e = all.exp();  // (1)
  if (!e.allFinite())
    detail::raise<bad_argument>("kte: discretize: the result overflows within " + detail::number(dt) + " s");
  return {e.topLeftCorner(n, n), e.block(0, n, n, m), c.C, c.D, e.topRightCorner(n, 1), c.y0, dt};
}
#endif

}  // namespace kte
