#pragma once

#include <kte/dynamics/mass_matrix_inverse.hpp>

#include "dynamics/trees.hpp"

/// The inverse of the mass matrix against the mass matrix inverted in long double.

namespace kte::test::trees {

/// Against M^-1; symmetric; the product of both.
struct errors_of_inverse {
  double inverse = 0, symmetric = 0, product = 0;

  template <class X, class Y, class M>
  void add(const X& x, const Y& exact, const M& mass) {
    inverse = std::max(inverse, gap(x, exact));
    symmetric = std::max(symmetric, gap(x, X(x.transpose())));
    const M one = mass * x;
    product = std::max(product, largest(M(one - M::Identity())) / (largest(mass) * largest(x)));
  }
  /// Bounds: M^-1 results from recursions, with the errors of forward dynamics (reference_test.cpp); the product has
  /// errors of N sums of numbers of the size of M times that of M^-1.
  void check() const {
    CHECK(inverse < 2e-15);
    CHECK(symmetric < 2e-15);
    CHECK(product < 2e-15);
  }
};

/// M^-1 column by column.
template <class S, int N>
joint_matrix<S, N> inverted(const joint_matrix<S, N>& mass) {
  joint_matrix<S, N> x;
  for (int j = 0; j < N; ++j) x.col(j) = solved<S, N>(mass, joint_vector<S, N>::Unit(j));
  return x;
}

/// In random positions, with bases at rest and with `outside` of a state anywhere.
template <class Chain, class... Outside>
void check_inverse(const Chain& model, unsigned seed, const Outside&... outside) {
  random_numbers random(seed);
  errors_of_inverse worst;
  auto s = make_state(model);
  auto exact = make_state<precise>(model);
  for (int round = 0; round < 20; ++round) {
    const trial<Chain> x(random);
    set_positions(s, x.q), set_velocities(s, x.v), set_accelerations(s, x.a), set_positions(exact, x.q);
    worst.add(mass_matrix_inverse(model, x.q), inverted(mass_matrix(model, x.q.template cast<precise>().eval())),
              mass_matrix(model, x.q));
    const unsigned outside_seed = 1000 * seed + static_cast<unsigned>(round);
    const auto set = [&](auto& state) {
      random_numbers draw(outside_seed);
      (move(state[outside], draw), ...);
    };
    set(s), set(exact);
    worst.add(mass_matrix_inverse(model, s), inverted(mass_matrix(model, exact)), mass_matrix(model, s));
  }
  worst.check();
}

}  // namespace kte::test::trees
