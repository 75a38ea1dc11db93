#pragma once

#include <cmath>

#include "models.hpp"
#include "timing.hpp"

/// Results known from elsewhere: of the robots to 31 digits, of the pendulum in closed form.
namespace bench {

enum class operation { passes, inverse_dynamics, mass_matrix, forward_dynamics, forward_kinematics };

constexpr const char* to_string(operation o) {
  constexpr const char* names[]{"passes", "inverse_dynamics", "mass_matrix", "forward_dynamics", "forward_kinematics"};
  return names[static_cast<int>(o)];
}

/// Whether a mass matrix is written in full or, by rows, from the diagonal on.
enum class triangle { both, upper };

template <int N>
expectation expect(operation o, triangle t, const kte::reference::state<N>& s) {
  expectation e;
  const auto x = [&](const double(&part)[N]) { e.x.insert(e.x.end(), part, part + N); };
  x(s.q), x(s.v), x(o == operation::forward_dynamics ? s.tau : s.a);
  const auto y = [&](const auto& part) { e.y.insert(e.y.end(), std::begin(part), std::end(part)); };
  const auto upper = [&](int i, int j) { return s.mass_matrix[i * N - i * (i + 1) / 2 + j]; };
  switch (o) {
    case operation::passes:
    case operation::inverse_dynamics:
      y(s.inverse_dynamics);
      break;
    case operation::mass_matrix:
      for (int i = 0; i < N; ++i)
        for (int j = t == triangle::both ? 0 : i; j < N; ++j) e.y.push_back(upper(std::min(i, j), std::max(i, j)));
      break;
    case operation::forward_dynamics:
      y(s.forward_dynamics);
      break;
    case operation::forward_kinematics:
      y(s.tool_rotation), y(s.tool_position);
      e.rotations = std::size(s.tool_rotation);
      break;
  }
  return e;
}

/// M = m l^2,  tau = M a + m g l cos q.
inline expectation expect_pendulum(operation o, double q, double v, double a) {
  const long double l = pendulum::length, mass = pendulum::mass * l * l;
  const long double c = std::cos(static_cast<long double>(q)), s = std::sin(static_cast<long double>(q));
  const long double weight = pendulum::mass * static_cast<long double>(pendulum::gravity) * l * c;
  switch (o) {
    case operation::passes:
    case operation::inverse_dynamics:
      return {{q, v, a}, {mass * a + weight}};
    case operation::mass_matrix:
      return {{q, v, a}, {mass}};
    case operation::forward_dynamics:
      return {{q, v, a}, {(a - weight) / mass}};
    case operation::forward_kinematics:
      return {{q, v, a}, {c, s, l * c, l * s}, 2};
  }
  return {};
}

template <class Model>
std::vector<expectation> expected(operation o, triangle t = triangle::both) {
  std::vector<expectation> all;
  if constexpr (std::is_same_v<Model, pendulum>) {
    for (const double q : {-3.0, -1.2, 0.3, 2.0}) all.push_back(expect_pendulum(o, q, 1.7, 2.5 - q));
  } else {
    for (const auto& s : Model::reference) all.push_back(expect(o, t, s));
  }
  return all;
}

/// Registers one way to evaluate an operation of a model.
template <class Model>
void add(operation o, const std::string& how, call f, triangle t = triangle::both) {
  add(to_string(o), how, Model::name, Model::dofs, f, expected<Model>(o, t));
}

}  // namespace bench
