#include <kte/models/moreau_jean.hpp>

#include "method.hpp"

namespace kte_python {

std::unique_ptr<any_solver> make_contact_solver(plant& p, const plant::state& x, double t, const solver_options& o) {
  // The plant holds the forces of control itself, while inputs move within steps.
  const kte::time_stepping_options options{.implicit_control = true};
  if (o.name == "moreau_jean") return solver_of<kte::moreau_jean>(p, x, t, o.step, options);
  return nullptr;
}

}  // namespace kte_python
