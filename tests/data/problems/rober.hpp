#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// ROBER, Robertson's reaction: three substances, rates from 4e-2 to 3e7, over 11 decades of time.
///
///   x_1' = -0.04 x_1 + 1e4 x_2 x_3
///   x_3' = 3e7 x_2^2                                       (1)
///   x_2' = -x_1' - x_3'
///
/// x_1 + x_2 + x_3 stays 1.
///
/// Mazzia and Magherini, Test Set for Initial Value Problem Solvers, 2008; Robertson 1966.
template <class S = double>
struct rober {
  static constexpr const char* name = "ROBER";
  static constexpr int size = 3;
  static constexpr long double t_end = 1e11L;
  using state = Eigen::Matrix<S, size, 1>;
  using matrix = Eigen::Matrix<S, size, size>;

  static state start() { return state(S(1), S(0), S(0)); }
  state operator()(const S&, const state& x) const {  // (1)
    const S first = 10000 * x[1] * x[2] - x[0] / 25, third = 30000000 * x[1] * x[1];
    return state(first, S(-first - third), third);
  }
  /// df/dx
  void jacobian(const S&, const state& x, matrix& J) const {
    J << S(-1) / S(25), S(10000 * x[2]), S(10000 * x[1]),  //
        S(0), S(0), S(0),                                  //
        S(0), S(60000000 * x[1]), S(0);
    J.row(1) = -J.row(0) - J.row(2);
  }

  /// Integrated twice at 50 digits, by Radau IIA of orders 17 and 21; only digits on which both agree.
  static constexpr known<3> references[3]{
      {0.4L, {0.985172113860989862415052930447L, 3.3863953789749041364498713e-5L, 0.014794022185220388543582570840L}},
      {40.0L,
       {0.715827068719405090474473751205L, 9.1855347645577639038992125778e-6L, 0.284163745745830351761622349582L}},
      {1e11L,
       {2.0833401497012942305725492799e-8L, 8.3333607703347834006476602862e-14L, 0.999999979166515169379354346441L}}};
  static constexpr const auto& reference = references[2].values;
};

}  // namespace kte::problems
