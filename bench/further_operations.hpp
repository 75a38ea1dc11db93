#pragma once

#include <string>

#include "timing.hpp"

namespace bench {

/// Registers the operations whose references only the textbook has. `Calls` has a function for each.
template <class Calls>
void add_further(const std::string& how, const std::string& model) {
  const auto add = [&](operation o, call<double> f) { bench::add(o, how, model, f); };
  add(operation::frames, Calls::frames);
  add(operation::kinetic_energy, Calls::kinetic_energy);
  add(operation::potential_energy, Calls::potential_energy);
  add(operation::gravity_forces, Calls::gravity_forces);
  add(operation::coriolis_matrix, Calls::coriolis_matrix);
  add(operation::jacobian_rate, Calls::jacobian_rate);
  add(operation::com_jacobian, Calls::com_jacobian);
  add(operation::momentum_matrix, Calls::momentum_matrix);
  add(operation::momentum_rate, Calls::momentum_rate);
}

}  // namespace bench
