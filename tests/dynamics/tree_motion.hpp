#pragma once

#include "dynamics/trees.hpp"

/// Inverse dynamics, mass matrix and forward dynamics of a chain against M^-1 (tau - bias), M and bias by inverse
/// dynamics in long double.
namespace kte::test::trees {

/// Error bounds, relative to the largest number:
///   rounding        inverse dynamics and mass matrix, static against runtime and long double; the forces that
///                   are missing at the accelerations found, against the largest force of inertia
///   accelerations   against the exact ones
struct bounds {
  double rounding, accelerations;
};

/// All algorithms on one chain, static and runtime, in random states; `outside` are the bases, inputs and coordinates
/// that are given.
template <class Chain, class... Outside>
void check(const Chain& chain, const runtime_chain& model, unsigned seed, const bounds& most,
           const Outside&... outside) {
  random_numbers random(seed);
  auto s = make_state(chain);
  auto r = model.make_state();
  auto exact = make_state<precise>(chain);
  struct {
    double same = 0, torques = 0, mass = 0, missing = 0, accelerations = 0;
  } worst;
  for (int round = 0; round < 20; ++round) {
    const trial<Chain> x(random);
    const unsigned outside_seed = 1000 * seed + static_cast<unsigned>(round);
    const auto set = [&](auto& state) {
      set_positions(state, x.q), set_velocities(state, x.v), set_accelerations(state, x.a);
      random_numbers draw(outside_seed);
      (move(thing_of(state, outside), draw), ...);
    };
    set(s), set(r), set(exact);

    // with all that the state says
    const auto tau = inverse_dynamics(chain, s);
    worst.same = std::max(worst.same, gap(inverse_dynamics(model, r), tau));
    worst.torques = std::max(worst.torques, gap(tau, inverse_dynamics(chain, exact)));
    set_accelerations(exact, typename trial<Chain>::vector(trial<Chain>::vector::Zero()));
    const auto bias = inverse_dynamics(chain, exact);
    joint_matrix<precise, Chain::dofs> M;
    for (int j = 0; j < Chain::dofs; ++j) {
      set_accelerations(exact, typename trial<Chain>::vector(trial<Chain>::vector::Unit(j)));
      M.col(j) = inverse_dynamics(chain, exact) - bias;
    }
    worst.mass = std::max({worst.mass, gap(mass_matrix(chain, s), M), gap(mass_matrix(model, r), M)});
    const auto y = solved(M, decltype(bias)(-bias));
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(chain, s), y));
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(model, r), y));
    // no forces are needed to make this motion happen: those of inertia and all others cancel
    const auto found = forward_dynamics(chain, s);
    const double size = largest(bias) + largest(M) * largest(found);
    set_accelerations(s, found), set_accelerations(r, found);
    worst.missing = std::max(worst.missing, largest(inverse_dynamics(chain, s)) / size);
    worst.missing = std::max(worst.missing, largest(inverse_dynamics(model, r)) / size);

    // with bases at rest and forces
    const auto driven = forward_dynamics(chain, x.q, x.v, x.tau);
    auto rest = model.make_state();
    worst.accelerations = std::max(worst.accelerations, gap(forward_dynamics(model, rest, x.q, x.v, x.tau), driven));
    const typename trial<Chain>::vector missing = inverse_dynamics(chain, x.q, x.v, driven) - x.tau;
    worst.missing = std::max(worst.missing, largest(missing) / (largest(x.tau) + largest(M) * largest(driven)));
  }
  CHECK(worst.same < most.rounding);
  CHECK(worst.torques < most.rounding);
  CHECK(worst.mass < most.rounding);
  CHECK(worst.missing < most.rounding);
  CHECK(worst.accelerations < most.accelerations);
}

template <class Chain, class... Outside>
void check(const Chain& chain, unsigned seed, const bounds& most, const Outside&... outside) {
  check(chain, models::element_by_element(chain), seed, most, outside...);
}

// Bounds: numbers on the way are up to some times as large as the largest result, and are rounded by eps/2 some ten
// times in a row: 20 eps; measured 2.3e-15. Accelerations may also have part of the condition of M; measured 1e-15,
// and 3e-15 by the mass matrix.
inline constexpr bounds usual{5e-15, 1e-14};

}  // namespace kte::test::trees
