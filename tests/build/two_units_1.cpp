// With two_units_2.cpp: two units that use one chain agree on it.
#include "robots/iiwa14.hpp"

const void* chain_seen_elsewhere();
double torque_computed_elsewhere(const double (&q)[7]);

int main() {
  const double q[]{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  const double torque = kte::inverse_dynamics(robots::iiwa14, q, q, q)[0];
  return chain_seen_elsewhere() == &robots::iiwa14 && torque_computed_elsewhere(q) == torque ? 0 : 1;
}
