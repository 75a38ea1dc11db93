#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>

#include "method.hpp"

namespace kte_python {

std::unique_ptr<any_solver> make_explicit_solver(plant& p, const plant::state& x, double t, const solver_options& o) {
  if (o.name == "dormand_prince45") return solver_of<kte::dormand_prince45>(p, x, t, o.tolerances);
  if (o.name == "prince_dormand87") return solver_of<kte::prince_dormand87>(p, x, t, o.tolerances);
  if (o.name == "adams") return vector_solver_of<kte::adams>(p, x, t, o.tolerances);
  return nullptr;
}

}  // namespace kte_python
