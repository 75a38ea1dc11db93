#include "data/derivatives.hpp"
#include "data/solo12.hpp"
#include "dynamics/inverse_error.hpp"
#include "robots/iiwa14.hpp"
#include "robots/solo12.hpp"
#include "robots/ur5.hpp"

// The inverse of the mass matrix of robots against 21 digits.

namespace mass_matrix_inverse_robots_test {

using namespace kte;
using namespace kte::test::trees;

template <class Chain, class States, int N, std::size_t Count>
void check_robot(const Chain& c, const States& states, const reference::derivatives<N> (&derivatives)[Count]) {
  errors_of_inverse worst;
  using matrix = joint_matrix<double, N>;
  for (std::size_t i = 0; i < Count; ++i) {
    const Eigen::Map<const joint_matrix<long double, N>> exact(derivatives[i].ddq_dtau);  // symmetric
    worst.add(mass_matrix_inverse(c, states[i].q), exact, matrix(mass_matrix(c, states[i].q)));
  }
  worst.check();
}

TEST_CASE("the inverse of the mass matrix of robots against 21 digits") {
  SECTION("iiwa14") { check_robot(robots::iiwa14, reference::iiwa14, reference::iiwa14_derivatives); }
  SECTION("ur5") { check_robot(robots::ur5, reference::ur5, reference::ur5_derivatives); }
  SECTION("solo12") { check_robot(robots::solo12, reference::solo12, reference::solo12_derivatives); }
}

}  // namespace mass_matrix_inverse_robots_test
