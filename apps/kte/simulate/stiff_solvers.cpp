#include "simulate/stiff_solvers.hpp"

#include <kte/integrators/bdf.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>

#include "simulate/method.hpp"

namespace kte_tool {

std::unique_ptr<plant_solver> make_stiff_solver(plant& p, const plant::state& x, const solver_options& o,
                                                const kte::tolerances<double>& exact) {
  if (o.name == "rodas") return method<kte::rodas>(p, x, exact);
  if (o.name == "kennedy_carpenter34") return method<kte::kennedy_carpenter34>(p, x, exact);
  if (o.name == "implicit_midpoint") return method<kte::implicit_midpoint>(p, x, o.step);
  if (o.name == "bdf") return vector_method<kte::bdf>(p, x, exact);
  return nullptr;
}

}  // namespace kte_tool
