// Built without exceptions and RTTI; see tests/CMakeLists.txt.
#include "robots/iiwa14.hpp"

double all_of_it(const double (&q)[7]);
double all_of_it(const double (&q)[7]) {
  const auto& c = robots::iiwa14;
  auto s = kte::make_state(c);
  c.doMotion(s);
  c.clearForce(s);
  c.doForce(s);
  return s[robots::iiwa14_names::q1].f + kte::inverse_dynamics(c, q, q, q)[0] + kte::mass_matrix(c, q)(0, 0) +
         kte::forward_dynamics(c, q, q, q)[0];
}
