#include "catch.hpp"
#include "chain/models.hpp"
#include "dynamics/double_error.hpp"
#include "dynamics/small_chains.hpp"
#include "eigenvalues.hpp"
#include "robots/iiwa14.hpp"

// Mass matrices by their columns, by a formula, at 50 digits. More: reference_test.cpp, serial_chains_test.cpp.

namespace mass_matrix_test {

using namespace kte;
using models::base, models::pendulum;
using test::small_chains::random_vector, test::small_chains::big;

// clang-format off
inline constexpr struct q_      final : coord_key<"q">         {} q;
inline constexpr struct finger1_ final : frame_2D_key<"finger1"> {} finger1;
inline constexpr struct finger2_ final : frame_2D_key<"finger2"> {} finger2;
inline constexpr struct tip_    final : frame_2D_key<"tip">    {} tip;
// clang-format on

/// Column j is what inverse dynamics says of an acceleration of coordinate j.
template <class Chain>
void check_columns(const Chain& c, unsigned seed) {
  constexpr int n = Chain::dofs;
  using V = joint_vector<double, n>;
  random_numbers random(seed);
  for (int round = 0; round < 200; ++round) {
    const V x = random_vector<double, n>(random, 3), v = random_vector<double, n>(random, 2);
    const auto M = mass_matrix(c, x);
    const V rest = inverse_dynamics(c, x, v, V(V::Zero()));
    const double size = std::max(rest.cwiseAbs().maxCoeff(), M.cwiseAbs().maxCoeff());
    for (int j = 0; j < n; ++j) {
      const V column = inverse_dynamics(c, x, v, V(V::Unit(j))) - rest;
      // The difference of two sums of size `size`, each of about ten roundings.
      CHECK((column - M.col(j)).cwiseAbs().maxCoeff() < 20 * 2.2e-16 * size);
    }
    CHECK(M == M.transpose());
    CHECK(test::eigenvalues_of(M)[0] > 0);
  }
}

TEST_CASE("columns of the mass matrix by inverse dynamics, of static chains") {
  check_columns(pendulum, 1);
  check_columns(models::tree, 2);
  check_columns(robots::iiwa14, 3);
}

TEST_CASE("mass matrix of two joints that share a coordinate") {
  // A parallel gripper: both fingers by one coordinate, in opposite directions.
  constexpr auto c = chain(prismatic_joint_2D(q, base, finger1, axis::x), inertia_2D(finger1, point_mass(2.0)),
                           prismatic_joint_2D(q, base, finger2, axis::y), inertia_2D(finger2, point_mass(3.0)),
                           prismatic_joint_2D(q, finger1, tip, axis::x), inertia_2D(tip, point_mass(5.0)));
  STATIC_REQUIRE(decltype(c)::dofs == 1);
  // Speeds 1, 1 and 2 for a unit rate: 2 + 3 + 5 4
  CHECK(mass_matrix(c, std::array{0.3})(0, 0) == 25.0);
  CHECK(inverse_dynamics(c, std::array{0.3}, std::array{0.0}, std::array{1.0})[0] == 25.0);
}

TEST_CASE("mass matrices of static and runtime chains agree") {
  const auto model = models::element_by_element(models::tree);
  auto s = model.make_state();
  random_numbers random(4);
  for (int round = 0; round < 100; ++round) {
    const auto x = random_vector<double, 3>(random, 3);
    const auto M = mass_matrix(models::tree, x);
    CHECK((M - mass_matrix(model, s, x)).norm() <= 20 * 2.2e-16 * (1 + M.norm()));
  }
}

TEST_CASE("mass matrix in double precision against 50 digits") {
  random_numbers random(6);
  for (int round = 0; round < 20; ++round) {
    const auto x = random_vector<double, 7>(random, 3);
    CHECK(test::error_of_double(mass_matrix(robots::iiwa14, x), mass_matrix(robots::iiwa14, test::at_50_digits(x))) <
          1e-15);
  }
}

}  // namespace mass_matrix_test
