#pragma once

/// Reference values for tests, examples and benchmarks.
namespace kte::reference {

/// A random state of a robot with N degrees of freedom, and what it gives to 31 digits under gravity (0, 0, -9.81).
template <int N>
struct state {
  double q[N], v[N], a[N], tau[N];
  long double inverse_dynamics[N];           ///< tau for the accelerations a
  long double bias[N];                       ///< tau for no acceleration
  long double forward_dynamics[N];           ///< accelerations under tau
  long double mass_matrix[N * (N + 1) / 2];  ///< upper triangle, by rows
  long double tool_rotation[9];              ///< by rows
  long double tool_position[3];
};

}  // namespace kte::reference
