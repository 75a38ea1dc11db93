#include "catch.hpp"
#include "data/problems/dzhanibekov.hpp"
#include "data/problems/heavy_top.hpp"
#include "data/problems/iiwa14_free_swing.hpp"
#include "data/problems/spherical_double_pendulum.hpp"
#include "integrators/mechanism_error.hpp"

namespace problems_space_test {

// The mechanisms of data/problems in space against their references, by the library's forward dynamics. How bounds were
// found is said in mechanism_error.hpp.

using namespace kte;
using namespace kte::problems;
using namespace kte::test;

/// At the end, with the tolerance 1e-12.
template <class Mechanism>
auto state_after(double t) {
  using problem = equation_of_motion<Mechanism>;
  auto solver = solver_of<problem>();
  solver.integrate(t);
  return typename problem::state(solver.state());
}

TEST_CASE("the spherical double pendulum reaches its references, without turns about its rods", "[long]") {
  using problem = equation_of_motion<spherical_double_pendulum>;
  // [400, 2000, 4000; 2e1, 5e2, 7e3; 7e-12, 4e-10, 5e-9]
  check_references<spherical_double_pendulum>(2e-10, {3e-11, 2e-9, 2e-8});
  CHECK(problem::energy(problem::start()) == within_relative(0.75, 1e-15));
  CHECK(problem::angular_momentum(problem::start())[2] == within_relative(1.0, 1e-15));
  const auto x = state_after<spherical_double_pendulum>(1);
  CHECK(problem::angular_momentum(x)[2] == within_relative(1.0, 1e-10));
  // The second rod lies along y of its frame.
  const auto w = frame_velocity(spherical_double_pendulum::model, problem::q(x), problem::v(x),
                                spherical_double_pendulum_names::rod2);
  CHECK(std::fabs(w.angular.y) < 1e-10);
  CHECK(std::fabs(problem::v(x)[0]) < 1e-10);
}
TEST_CASE("a free body flips as Dzhanibekov saw, with the momentum it has", "[long]") {
  using problem = equation_of_motion<dzhanibekov>;
  // [284, 3161, 31304; 3e2, 3e6, 2e7; 7e-12, 1e-8, 3e-8]: the start is almost an unstable turn
  check_references<dzhanibekov>(4e-9, {3e-11, 6e-8, 2e-7});
  const Eigen::Vector3d h(0.01, 20, 0.03);
  CHECK((problem::angular_momentum(problem::start()) - h).norm() < 1e-15);
  CHECK((problem::angular_momentum(state_after<dzhanibekov>(10)) - h).norm() < 1e-9);
  CHECK(problem::energy(problem::start()) == within_relative(100.0002, 1e-15));
}
TEST_CASE("the heavy top reaches its references", "[long]") {
  using problem = equation_of_motion<heavy_top>;
  // [950, 9600, 19000; 2e2, 9e2, 2e3; 2e-11, 2e-10, 2e-10]
  check_references<heavy_top>(2e-7, {1e-10, 1e-9, 1e-9});
  CHECK(problem::energy(problem::start()) == within_relative(5435.696790865546875, 1e-15));
  CHECK(problem::angular_momentum(problem::start())[2] == within_relative(-70.3124296875, 1e-15));
}
TEST_CASE("the robot swings freely to its reference", "[long]") {
  check_references<iiwa14_free_swing>(5e-10, {5e-9});  // [1600, 3e4, 1e-9], with rates up to 78 rad/s
}
}  // namespace problems_space_test
