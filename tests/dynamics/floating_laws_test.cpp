#include "dynamics/floating_bodies.hpp"

// Laws that the algorithms obey together where bodies float.

namespace floating_laws_test {

using namespace kte;
using namespace kte::test::floating_bodies;
using models::element_by_element;

/// Columns of M by inverse dynamics, forward after inverse dynamics, static against runtime.
template <class Chain>
void check_identities(const Chain& c, unsigned seed, int rounds) {
  constexpr int n = Chain::dofs;
  using V = joint_vector<double, n>;
  random_numbers random(seed);
  const auto runtime = element_by_element(c);
  auto r = runtime.make_state();
  for (int round = 0; round < rounds; ++round) {
    const auto q = random_configuration(c, random);
    const V v = random_vector<double, n>(random, 2), a = random_vector<double, n>(random, 5);
    const auto M = mass_matrix(c, q);
    CHECK(M == M.transpose());
    const V rest = inverse_dynamics(c, q, v, V(V::Zero()));
    const double size = std::max(rest.cwiseAbs().maxCoeff(), M.cwiseAbs().maxCoeff());
    // The difference of two sums of size `size`, each of about ten roundings.
    for (int j = 0; j < n; ++j)
      CHECK(gap(V(inverse_dynamics(c, q, v, V(V::Unit(j))) - rest), M.col(j)) < 20 * eps * size);
    const Eigen::VectorXd eigenvalues = eigenvalues_of(M);
    REQUIRE(eigenvalues[0] > 0);
    const double condition = eigenvalues[n - 1] / eigenvalues[0];
    const V tau = inverse_dynamics(c, q, v, a);
    const double bound =
        20 * eps * condition * std::max(a.norm(), std::max(tau.norm(), rest.norm()) / eigenvalues[n - 1]);
    CHECK((forward_dynamics(c, q, v, tau) - a).norm() < bound);
    CHECK((forward_dynamics(runtime, r, q, v, tau) - a).norm() < bound);
    CHECK(gap(inverse_dynamics(runtime, r, q, v, a), tau) <= 20 * eps * std::max(size, tau.cwiseAbs().maxCoeff()));
    CHECK(gap(mass_matrix(runtime, r, q), M) <= 20 * eps * M.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("mass matrix by columns, forward dynamics after inverse dynamics, floating") {
  check_identities(lone, 6, 50);
  check_identities(pair_of_bodies, 7, 50);
  check_identities(hanging, 8, 50);
}

TEST_CASE("two floating bodies in one chain are two bodies") {
  // A free joint on what floats moves relative to it; the mass matrix of both has the products of inertia between.
  constexpr auto nested = chain(free_joint_3D(trunk, ground, body), inertia_3D(body, brick),
                                spherical_joint_3D(ball, body, socket), inertia_3D(socket, stick), base_2D(table),
                                free_joint_2D(puck, table, disc), inertia_2D(disc, planar_body(1.0, 0.1)))
                              .gravity(weight);
  random_numbers random(14);
  const auto q = random_configuration(nested, random);
  const auto M = mass_matrix(nested, q);
  CHECK(M.block(0, 9, 9, 3) == Eigen::MatrixXd::Zero(9, 3));
  CHECK(M.block(9, 9, 3, 3).isApprox(Eigen::Vector3d(1.0, 1.0, 0.1).asDiagonal().toDenseMatrix(), 4 * eps));
  CHECK(M.block(0, 6, 3, 3).norm() > 0.1);
  check_identities(nested, 15, 20);
}

}  // namespace floating_laws_test
