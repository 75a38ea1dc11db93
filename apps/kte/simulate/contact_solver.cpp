#include "simulate/contact_solver.hpp"

#include <kte/models/moreau_jean.hpp>

#include "simulate/method.hpp"

namespace kte_tool {

std::unique_ptr<plant_solver> contact_method(plant& p, const plant::state& x, double step) {
  return method<kte::moreau_jean>(p, x, step, kte::time_stepping_options{.implicit_control = true});
}

}  // namespace kte_tool
