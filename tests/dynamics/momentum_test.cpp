#include <kte/dynamics/momentum.hpp>

#include "dynamics/small_chains.hpp"
#include "static_models/static_model.hpp"

namespace momentum_test {

// Generalized momenta: against the mass matrix, and their change along the velocities against differences.

using namespace kte;
using namespace kte::test;
using small_chains::big, small_chains::by_differences, small_chains::derivative, small_chains::gap;

void check_momenta(const model& x, unsigned seed) {
  const auto& c = x.in_double;
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion<double> m(x.runtime, random);
    const Eigen::VectorXd p = c.mass_matrix(m.q) * m.v;
    // sums of a few products along at most 12 frames, in another order
    CHECK((c.generalized_momenta(m.q, m.v) - p).norm() <= 100 * 2.2e-16 * p.norm());
  }
}
template <const auto& Chain>
void check_change(const model& x, unsigned seed) {
  const auto& c = x.exact;
  random_numbers random(seed);
  const random_motion<big> m(x.runtime, random);
  const auto [p, change] = generalized_momenta_along(Chain, m.q, m.v);
  CHECK(gap(p, c.generalized_momenta(m.q, m.v)) < 1e-45);
  static_model<big>::vector differences(c.dofs);
  for (int i = 0; i < c.dofs; ++i)
    differences[i] = derivative([&](const big& t) { return c.generalized_momenta(c.integrate(m.q, m.v, t), m.v)[i]; });
  CHECK(gap(change, differences) < by_differences);
}

TEST_CASE("generalized momenta are the mass matrix times velocities") {
  check_momenta(static_models::iiwa14(), 1);
  check_momenta(static_models::floating_with_springs(), 3);
  check_momenta(static_models::planar(), 4);
  check_momenta(static_models::geared(), 5);
}

TEST_CASE("their change along the velocities is a derivative") {
  check_change<small_chains::floating_with_springs>(static_models::floating_with_springs(), 12);
  check_change<small_chains::planar>(static_models::planar(), 13);
  check_change<small_chains::geared>(static_models::geared(), 14);
}

}  // namespace momentum_test
