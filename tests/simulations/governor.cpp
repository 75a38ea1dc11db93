#include "catch.hpp"
#include "data/problems/flyball_governor.hpp"
#include "integrators/mechanism_error.hpp"

namespace governor {

using namespace kte;
using namespace kte::problems;
using namespace kte::test;

TEST_CASE("the governor reaches its references by explicit steps, both rods alike", "[long]") {
  using problem = equation_of_motion<flyball_governor>;
  // [1400, 4900, 9600, 95000; 1e1, 1e1, 1e1, 5e1; 6e-13, 1e-12, 2e-12, 3e-12]: stability limits steps, not accuracy.
  // The damper takes 3e-3 J.
  check_references<flyball_governor>(4e-3, {3e-12, 5e-12, 1e-11, 1e-11});
  auto solver = solver_of<problem>();
  solver.integrate(0.5);
  const problem::state x(solver.state());
  CHECK(problem::q(x)[2] == within_relative(problem::q(x)[3], 1e-13));
}

}  // namespace governor
