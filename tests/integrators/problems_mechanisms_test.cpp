#include "catch.hpp"
#include "data/problems/double_pendulum.hpp"
#include "data/problems/elastic_pendulum_chain.hpp"
#include "data/problems/pendulum.hpp"
#include "data/problems/ten_rods.hpp"
#include "integrators/mechanism_error.hpp"

namespace problems_mechanisms_test {

// The mechanisms of data/problems in the plane against their references, by the library's forward dynamics. How bounds
// were found is said in mechanism_error.hpp.

using namespace kte;
using namespace kte::problems;
using namespace kte::test;

TEST_CASE("the pendulum reaches its references") {
  check_references<problems::pendulum>(1e-9,
                                       {1e-11, 2e-9, 5e-8});  // [218, 2200, 11000; 9, 1e2, 5e2; 2e-12, 4e-10, 9e-9]
}
TEST_CASE("the double pendulum reaches its references") {
  // [400, 1800, 3700; 1e1, 6e1, 8e2; 2e-12, 3e-11, 6e-10]
  check_references<double_pendulum_from_horizontal>(4e-10, {1e-11, 2e-10, 3e-9});
  // [420, 2000, 4100; 2e1, 9e2, 1e5; 3e-12, 1e-9, 1e-7]
  check_references<double_pendulum_from_2_rad>(4e-10, {1e-11, 5e-9, 6e-7});
  CHECK(equation_of_motion<double_pendulum_from_2_rad>::energy(
            equation_of_motion<double_pendulum_from_2_rad>::start()) == within_relative(12.2472013995824004493, 1e-15));
}
TEST_CASE("the elastic pendulum reaches its references as a chain too") {
  // [640, 3200, 6300; G 1e2; 1e-11, 6e-11, 2e-10]
  check_references<elastic_pendulum_chain>(2e-9, {5e-11, 3e-10, 1e-9});
}
TEST_CASE("ten rods reach their references") {
  check_references<ten_rods>(2e-11, {1e-12, 2e-12});  // [380, 1040; 2e1, 1e2; 2e-13, 4e-13]
}
TEST_CASE("mechanisms in long double: a thousandth of the error") {
  using problem = equation_of_motion<double_pendulum_from_horizontal, long double>;
  dormand_prince45 solver(problem{}, 0.0L, problem::start(), {.absolute = 1e-15L, .relative = 1e-15L});
  solver.integrate(1);
  CHECK(largest_error(problem::output(solver.state()), double_pendulum_from_horizontal::references[0].values) < 1e-14L);
}

}  // namespace problems_mechanisms_test
