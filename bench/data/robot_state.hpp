#pragma once

namespace kte::reference {

/// A random state of a robot with NQ numbers in q and N degrees of freedom, and what it gives to 31 digits under
/// gravity (0, 0, -9.81). Floating robots: as `floating_state` of tests/data/solo12.hpp.
template <int NQ, int N>
struct robot_state {
  double q[NQ], v[N], a[N], tau[N];
  long double inverse_dynamics[N];           ///< tau for the accelerations a
  long double forward_dynamics[N];           ///< accelerations under tau
  long double mass_matrix[N * (N + 1) / 2];  ///< upper triangle, by rows
};

}  // namespace kte::reference
