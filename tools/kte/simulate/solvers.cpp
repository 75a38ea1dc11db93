#include "simulate/solvers.hpp"

#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>
#include <kte/models/vector_form.hpp>

#include "command_line.hpp"
#include "simulate/run_with.hpp"
#include "simulate/stiff_solvers.hpp"

namespace kte_tool {

const char* const solvers_by_tolerance = "dormand_prince45, prince_dormand87, adams, bdf, rodas, kennedy_carpenter34";
const char* const solvers_of_fixed_step = "runge_kutta4, semi_implicit_euler, implicit_midpoint";

run_result run(plant& p, plant::state& x, const run_settings& s, const run_observer& observe) {
  const kte::tolerances<double> exact{.absolute = s.tolerance, .relative = s.tolerance, .max_steps = 1'000'000'000};
  const auto f = std::ref(p);
  const auto& name = s.solver;
  if (name == "dormand_prince45") return run_method<kte::dormand_prince45>(f, p, x, s, observe, exact);
  if (name == "prince_dormand87") return run_method<kte::prince_dormand87>(f, p, x, s, observe, exact);
  if (name == "runge_kutta4") return run_method<kte::runge_kutta4>(f, p, x, s, observe, s.step);
  if (name == "semi_implicit_euler") return run_method<kte::semi_implicit_euler>(f, p, x, s, observe, s.step);
  if (name == "adams") {
    kte::vector_form flat(f);
    return run_method<kte::adams>(std::ref(flat), p, x, s, observe, exact);
  }
  if (const auto result = run_stiff(p, x, s, observe, exact)) return *result;
  throw usage_error("there is no solver '" + name + "', but " + solvers_by_tolerance + "; " + solvers_of_fixed_step);
}

}  // namespace kte_tool
