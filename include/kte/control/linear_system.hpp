#pragma once

#include <Eigen/Core>

namespace kte {

/// A linear system about a state x0 and inputs u0, in displacements d from x0 and changes du of the inputs:
///
///   d' = x_dot + A d + B du          (1)
///   y  = y0 + C d + D du             (2)
///
/// d has as many numbers as x' (2 n plus internal states, for n degrees of freedom). x0 need not be an equilibrium:
/// x_dot is f(t, x0, u0). SI units.
template <class S = double>
struct linear_system {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  matrix A, B, C, D;
  vector x_dot;  ///< f(t, x0, u0)
  vector y0;     ///< h(t, x0, u0)
};

/// A linear system in discrete time, with inputs that are constant within an interval (`discretize`):
///
///   d_(k+1) = step + A d_k + B du_k,   y_k = y0 + C d_k + D du_k
template <class S = double>
struct discrete_linear_system {
  using matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

  matrix A, B, C, D;
  vector step;  ///< d after one interval from d = 0, du = 0; zero at an equilibrium
  vector y0;
  S dt{};  ///< s
};

}  // namespace kte
