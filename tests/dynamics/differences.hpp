#pragma once

#include "digits50.hpp"
#include "dynamics/trees.hpp"

/// Derivatives by central differences at 50 digits, to judge others by.
namespace kte::test {

using big = digits50;

/// Keeps the worse of both.
inline void note(double& worst, double d) { worst = worse(worst, d); }

/// Central differences of f(state) by q, v or a, along each velocity; steps of 1e-16 err by 1e-32 times a third
/// derivative and lose 1e-34.
enum class by { q, v, a };
template <class Chain, class State, class F>
auto differences(const Chain& c, const State& s, by what, const F& f) {
  constexpr int n = Chain::dofs;
  using vector = joint_vector<big, n>;
  const big step("1e-16");
  joint_matrix<big, n> m;
  for (int j = 0; j < n; ++j) {
    const auto at = [&](const big& h) {
      auto t = s;
      const vector e = vector::Unit(j);
      if (what == by::q) set_positions(t, integrate(c, positions(s), e, h));
      if (what == by::v) set_velocities(t, vector(velocities(s) + h * e));
      if (what == by::a) set_accelerations(t, vector(accelerations(s) + h * e));
      return vector(f(t));
    };
    m.col(j) = (at(step) - at(-step)) / (2 * step);
  }
  return m;
}

}  // namespace kte::test
