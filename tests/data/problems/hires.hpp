#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// HIRES: how light shapes a growing plant. Eight reactions, stiff:
///
///   x' = A x + b + 280 x_6 x_8 (0, 0, 0, 0, 0, -1, 1, -1)          (1)
///
/// Mazzia and Magherini, Test Set for Initial Value Problem Solvers, 2008; E. Schaefer 1975.
template <class S = double>
struct hires {
  static constexpr const char* name = "HIRES";
  static constexpr int size = 8;
  static constexpr long double t_end = 321.8122L;
  using state = Eigen::Matrix<S, size, 1>;
  using matrix = Eigen::Matrix<S, size, size>;

  static state start() {
    state x = state::Zero();
    x[0] = 1;
    x[7] = S(57) / S(10000);
    return x;
  }
  state operator()(const S&, const state& x) const {  // (1)
    const S binding = 280 * x[5] * x[7], release = percent(181) * x[6];
    state f;
    f[0] = -percent(171) * x[0] + percent(43) * x[1] + percent(832) * x[2] + S(7) / S(10000);
    f[1] = percent(171) * x[0] - percent(875) * x[1];
    f[2] = -percent(1003) * x[2] + percent(43) * x[3] + S(35) / S(1000) * x[4];
    f[3] = percent(832) * x[1] + percent(171) * x[2] - percent(112) * x[3];
    f[4] = -S(1745) / S(1000) * x[4] + percent(43) * (x[5] + x[6]);
    f[5] = -binding + percent(69) * x[3] + percent(171) * x[4] - percent(43) * x[5] + percent(69) * x[6];
    f[6] = binding - release;
    f[7] = release - binding;
    return f;
  }
  /// df/dx
  void jacobian(const S&, const state& x, matrix& J) const {
    J.setZero();
    J(0, 0) = -percent(171), J(0, 1) = percent(43), J(0, 2) = percent(832);
    J(1, 0) = percent(171), J(1, 1) = -percent(875);
    J(2, 2) = -percent(1003), J(2, 3) = percent(43), J(2, 4) = S(35) / S(1000);
    J(3, 1) = percent(832), J(3, 2) = percent(171), J(3, 3) = -percent(112);
    J(4, 4) = -S(1745) / S(1000), J(4, 5) = J(4, 6) = percent(43);
    J(5, 3) = percent(69), J(5, 4) = percent(171), J(5, 5) = -percent(43) - 280 * x[7];
    J(5, 6) = percent(69), J(5, 7) = -280 * x[5];
    J(6, 5) = 280 * x[7], J(6, 6) = -percent(181), J(6, 7) = 280 * x[5];
    J.row(7) = -J.row(6);
  }

  /// Integrated twice at 50 digits, by Radau IIA of orders 17 and 21; only digits on which both agree.
  static constexpr known<8> references[1]{
      {321.8122L,
       {7.37131257332566780727729185330e-4L, 1.44248572631618465818804085037e-4L, 5.8887297409675750074847844170e-5L,
        0.00117565134328314914550604442766L, 0.00238635619883133046882098882261L, 0.0062389682527427957866469326544L,
        0.002849998395185768657931115898L, 0.002850001604814231342068884102L}}};
  static constexpr const auto& reference = references[0].values;

 private:
  static S percent(int n) { return S(n) / S(100); }
};

}  // namespace kte::problems
