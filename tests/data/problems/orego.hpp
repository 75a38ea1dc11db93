#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// OREGO, the Oregonator: a reaction of Belousov and Zhabotinskii that oscillates. Stiff.
///
///   x_1' = s (x_2 - x_1 x_2 + x_1 - q x_1^2)
///   x_2' = (x_3 - x_2 - x_1 x_2) / s                       (1)
///   x_3' = w (x_1 - x_3),   s = 77.27, w = 0.161, q = 8.375e-6
///
/// Mazzia and Magherini, Test Set for Initial Value Problem Solvers, 2008; Field and Noyes, J. Chem. Phys. 60 (1974).
template <class S = double>
struct orego {
  static constexpr const char* name = "OREGO";
  static constexpr int size = 3;
  static constexpr long double t_end = 360L;
  using state = Eigen::Matrix<S, size, 1>;
  using matrix = Eigen::Matrix<S, size, size>;

  static state start() { return state(S(1), S(2), S(3)); }
  state operator()(const S&, const state& x) const {  // (1)
    return state(S(s() * (x[1] - x[0] * x[1] + x[0] - q() * x[0] * x[0])), S((x[2] - x[1] - x[0] * x[1]) / s()),
                 S(w() * (x[0] - x[2])));
  }
  /// df/dx
  void jacobian(const S&, const state& x, matrix& J) const {
    J << S(s() * (1 - x[1] - 2 * q() * x[0])), S(s() * (1 - x[0])), S(0),  //
        S(-x[1] / s()), S(-(1 + x[0]) / s()), S(1 / s()),                  //
        w(), S(0), S(-w());
  }

  /// Integrated twice at 50 digits, by Radau IIA of orders 17 and 21; only digits on which both agree.
  static constexpr known<3> references[1]{
      {360.0L, {1.000814870318522716281641752L, 1228.17852154988798371801700008L, 132.055494284650828774223271899L}}};
  static constexpr const auto& reference = references[0].values;

 private:
  static S s() { return S(7727) / S(100); }
  static S w() { return S(161) / S(1000); }
  static S q() { return S(8375) / S(1000000000); }
};

}  // namespace kte::problems
