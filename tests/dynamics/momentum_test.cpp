#include <kte/dynamics/momentum.hpp>

#include "dynamics/small_chains.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"

// Generalized momenta: against the mass matrix, and their change along the velocities against differences.

namespace momentum_test {

using namespace kte;
using namespace kte::test;
using namespace kte::test::small_chains;

template <class Chain>
void check_momenta(const Chain& c, unsigned seed) {
  random_numbers random(seed);
  for (int round = 0; round < 3; ++round) {
    const random_motion_of<double, Chain> m(c, random);
    const joint_vector<double, Chain::dofs> p = mass_matrix(c, m.q) * m.v;
    // sums of a few products along at most 12 frames, in another order
    CHECK((generalized_momenta(c, m.q, m.v) - p).norm() <= 100 * 2.2e-16 * p.norm());
  }
}
template <class Chain>
void check_change(const Chain& c, unsigned seed) {
  random_numbers random(seed);
  const random_motion_of<big, Chain> m(c, random);
  const auto [p, change] = generalized_momenta_along(c, m.q, m.v);
  CHECK(gap(p, generalized_momenta(c, m.q, m.v)) < 1e-45);
  joint_vector<big, Chain::dofs> differences;
  for (int i = 0; i < Chain::dofs; ++i)
    differences[i] =
        derivative([&](const big& t) { return generalized_momenta(c, integrate(c, m.q, m.v, t), m.v)[i]; });
  CHECK(gap(change, differences) < by_differences);
}

TEST_CASE("generalized momenta are the mass matrix times velocities") {
  check_momenta(robots::iiwa14, 1);
  check_momenta(floating_with_springs, 3);
  check_momenta(planar, 4);
  check_momenta(geared, 5);
}

TEST_CASE("their change along the velocities is a derivative") {
  check_change(floating_with_springs, 12);
  check_change(planar, 13);
  check_change(geared, 14);
}

}  // namespace momentum_test
