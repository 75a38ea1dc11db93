#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// Van der Pol's oscillator, so stiff that it jumps: x_1 creeps for 800 s and falls within 1 ms.
///
///   x_1' = x_2,   x_2' = mu (1 - x_1^2) x_2 - x_1,   mu = 1000          (1)
///
/// Mazzia and Magherini, Test Set for Initial Value Problem Solvers, 2008, VDPOL.
template <class S = double>
struct vdpol {
  static constexpr const char* name = "VDPOL, mu = 1000";
  static constexpr int size = 2;
  static constexpr long double t_end = 2000L;
  using state = Eigen::Matrix<S, size, 1>;
  using matrix = Eigen::Matrix<S, size, size>;
  static constexpr int mu = 1000;

  static state start() { return state(S(2), S(0)); }
  state operator()(const S&, const state& x) const {  // (1)
    return state(x[1], S(S(mu) * (1 - x[0] * x[0]) * x[1] - x[0]));
  }
  /// df/dx
  void jacobian(const S&, const state& x, matrix& J) const {
    J << S(0), S(1), S(S(-2 * mu) * x[0] * x[1] - 1), S(S(mu) * (1 - x[0] * x[0]));
  }

  /// Integrated twice at 50 digits, by Radau IIA of orders 17 and 21; only digits on which both agree.
  static constexpr known<2> references[1]{
      {2000.0L, {1.706167732170465008478187592L, -8.92809701024816547778603065e-4L}}};
  static constexpr const auto& reference = references[0].values;
};

}  // namespace kte::problems
