// Built without exceptions and RTTI; see tests/CMakeLists.txt.
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>

#include "robots/iiwa14.hpp"

double all_of_it(const double (&q)[7]);
double all_of_it(const double (&q)[7]) {
  const auto& c = robots::iiwa14;
  auto s = kte::make_state(c);
  c.doMotion(s);
  c.clearForce(s);
  c.doForce(s);
  const kte::manipulator_dynamics_model model(c);
  kte::dormand_prince45 solver(std::cref(model), 0.0, model.make_x(q, q));
  solver.integrate(0.1);
  return solver.state()[0] + s[robots::iiwa14_names::q1].f + kte::inverse_dynamics(c, q, q, q)[0] +
         kte::mass_matrix(c, q)(0, 0) + kte::forward_dynamics(c, q, q, q)[0];
}
