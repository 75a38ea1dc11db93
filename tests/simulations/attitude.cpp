#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>

#include "catch.hpp"
#include "models/free_motion.hpp"

namespace attitude_test {

using namespace kte;
using namespace kte::test::free_motion;
using kte::problems::dzhanibekov;

TEST_CASE("the attitude of a free body after 100 s, by Kutta's method on the group", "[long]") {
  // About the unstable axis a rounding of the rates costs 1e6 times as much in the time of a flip. Compensated
  // summation keeps that of 5e5 steps, not compensated it is 3e-8. The momentum: what the method misses at this step;
  // by one of order 5 it is 2e-16, and was 2e-14 where rotations were not compensated.
  auto solver = start<runge_kutta4, dzhanibekov>(2e-4);
  const auto before = momenta(dzhanibekov::model, solver.state());
  solver.integrate(100);
  CHECK(error_of<dzhanibekov>(solver.state(), 2) < 2e-9);
  CHECK((momenta(dzhanibekov::model, solver.state()) - before).norm() < 2e-13 * before.norm());
  CHECK(std::abs(solver.state().head<4>().norm() - 1) < 1e-15);
  auto finer = start<runge_kutta5, dzhanibekov>(2e-4);
  finer.integrate(100);
  CHECK((momenta(dzhanibekov::model, finer.state()) - before).norm() < 1e-15 * before.norm());
}

}  // namespace attitude_test
