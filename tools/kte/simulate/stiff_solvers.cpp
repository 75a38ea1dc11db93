#include "simulate/stiff_solvers.hpp"

#include <kte/integrators/bdf.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/kennedy_carpenter34.hpp>
#include <kte/integrators/rodas.hpp>
#include <kte/models/vector_form.hpp>

#include "simulate/run_with.hpp"

namespace kte_tool {

std::optional<run_result> run_stiff(plant& p, plant::state& x, const run_settings& s, const run_observer& observe,
                                    const kte::tolerances<double>& exact) {
  const auto f = std::ref(p);
  if (s.solver == "rodas") return run_method<kte::rodas>(f, p, x, s, observe, exact);
  if (s.solver == "kennedy_carpenter34") return run_method<kte::kennedy_carpenter34>(f, p, x, s, observe, exact);
  if (s.solver == "implicit_midpoint") return run_method<kte::implicit_midpoint>(f, p, x, s, observe, s.step);
  if (s.solver == "bdf") {
    kte::vector_form flat(f);
    return run_method<kte::bdf>(std::ref(flat), p, x, s, observe, exact);
  }
  return {};
}

}  // namespace kte_tool
