#include <kte/integrators/bdf.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/integrators/rosenbrock23.hpp>
#include <kte/integrators/tr_bdf2.hpp>
#include <kte/integrators/trapezoidal.hpp>

#include "method.hpp"

namespace kte_python {

std::unique_ptr<any_solver> make_stiff_solver(plant& p, const plant::state& x, double t, const solver_options& o) {
  if (o.name == "bdf") return vector_solver_of<kte::bdf>(p, x, t, o.tolerances);
  if (o.name == "rodas") return solver_of<kte::rodas>(p, x, t, o.tolerances);
  if (o.name == "rosenbrock23") return solver_of<kte::rosenbrock23>(p, x, t, o.tolerances);
  if (o.name == "kennedy_carpenter34") return solver_of<kte::kennedy_carpenter34>(p, x, t, o.tolerances);
  if (o.name == "tr_bdf2") return solver_of<kte::tr_bdf2>(p, x, t, o.tolerances);
  if (o.name == "trapezoidal") return solver_of<kte::trapezoidal>(p, x, t, o.tolerances);
  return nullptr;
}

}  // namespace kte_python
