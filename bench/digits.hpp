#pragma once

#include <algorithm>
#include <vector>

#include "data/solo12.hpp"
#include "operation.hpp"

/// Results as they stand in tests/data.
namespace bench {

using real = long double;
using block = std::vector<real>;

inline block transposed(const real* by_rows, int rows, int columns) {
  block b;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) b.push_back(by_rows[i * columns + j]);
  return b;
}
template <int N>
block list(const real (&x)[N]) {
  return {x, x + N};
}

/// The expected results at a state of a robot, with derivatives if known; empty if the data do not have them.
template <class State, int N>
std::vector<block> from_digits(operation o, const State& s, const kte::reference::derivatives<N>* d) {
  constexpr bool floats = requires { s.foot_jacobian; };
  switch (o) {
    case operation::passes:
    case operation::inverse_dynamics:
      return {list(s.inverse_dynamics)};
    case operation::nonlinear_effects:
      if constexpr (requires { s.bias; }) return {list(s.bias)};
      return {};
    case operation::forward_dynamics:
      return {list(s.forward_dynamics)};
    case operation::mass_matrix: {
      block m;
      const auto upper = [&](int i, int j) { return s.mass_matrix[i * N - i * (i + 1) / 2 + j]; };
      for (int j = 0; j < N; ++j)
        for (int i = 0; i < N; ++i) m.push_back(upper(std::min(i, j), std::max(i, j)));
      return {m};
    }
    case operation::frames:
    case operation::forward_kinematics:
      if constexpr (floats) return {list(s.foot_rotation), list(s.foot_position)};
      if constexpr (requires { s.tool_rotation; }) return {list(s.tool_rotation), list(s.tool_position)};
      return {};
    case operation::jacobian:
      if constexpr (floats) return {transposed(s.foot_jacobian, 6, N)};
      return {};
    case operation::mass_matrix_inverse:
    case operation::id_derivatives:
    case operation::fd_derivatives:
      break;
    default:
      return {};
  }
  if (d == nullptr) return {};
  const auto square = [](const real(&x)[N * N]) { return transposed(x, N, N); };
  if (o == operation::mass_matrix_inverse) return {square(d->ddq_dtau)};
  if (o == operation::fd_derivatives)
    return {list(s.forward_dynamics), square(d->ddq_dq), square(d->ddq_dv), square(d->ddq_dtau)};
  return {list(s.inverse_dynamics), square(d->dtau_dq), square(d->dtau_dv),
          from_digits(operation::mass_matrix, s, d).front()};
}

}  // namespace bench
