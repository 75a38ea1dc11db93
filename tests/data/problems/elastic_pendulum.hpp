#pragma once

#include <Eigen/Core>

#include "data/problems/error.hpp"

namespace kte::problems {

/// A mass of 1 kg on a spring that swings in the plane, from (1.2, 0) m at rest, y up:
///
///   r'' = -k (1 - L/|r|) r - (0, g),   k = 100 N/m, L = 1 m, g = 9.81 m/s^2          (1)
///
/// State: x, y, their rates.
template <class S = double>
struct elastic_pendulum {
  static constexpr const char* name = "elastic pendulum";
  static constexpr int size = 4;
  static constexpr long double t_end = 10L;
  using state = Eigen::Matrix<S, size, 1>;

  static state start() { return state(S(S(6) / S(5)), S(0), S(0), S(0)); }
  state operator()(const S&, const state& x) const {
    using std::sqrt;
    const S pull = 100 / sqrt(S(x[0] * x[0] + x[1] * x[1])) - 100;
    return state(x[2], x[3], S(pull * x[0]), S(pull * x[1] - g()));  // (1)
  }
  /// Kinetic, of the spring and of gravity, J; constant: 2.
  S energy(const state& x) const {
    using std::sqrt;
    const S stretch = sqrt(S(x[0] * x[0] + x[1] * x[1])) - 1;
    return (x[2] * x[2] + x[3] * x[3]) / 2 + 50 * stretch * stretch + g() * x[1];
  }

  /// Integrated twice at 60 digits, by extrapolation of different orders; only digits on which both agree.
  static constexpr known<4> references[3]{{1.0L,
                                           {-1.07770747717887830638184443687L, -0.476691398435129174959054907787L,
                                            -2.64532643062777334841201078487L, 1.78082723900903430808276599246L}},
                                          {5.0L,
                                           {1.03832925084550145748999989232L, -0.151497129207625166643742524994L,
                                            2.02895509192920407210736708905L, 1.61630377049431792339091137534L}},
                                          {10.0L,
                                           {0.736389433042592204232149823528L, -0.587796216796016537268596031625L,
                                            1.87092634978372662458699439665L, 3.42027988131703818264287950326L}}};
  static constexpr const auto& reference = references[2].values;

 private:
  static S g() { return S(981) / S(100); }
};

}  // namespace kte::problems
