#include "simulate/solvers.hpp"

#include <kte/integrators/adams.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/prince_dormand87.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>

#include "simulate/contact_solver.hpp"
#include "simulate/method.hpp"
#include "simulate/stiff_solvers.hpp"
#include "text_format.hpp"

namespace kte_tool {

namespace {
constexpr const char* by_tolerance = "dormand_prince45, prince_dormand87, adams, bdf, rodas, kennedy_carpenter34";
constexpr const char* of_fixed_step =
    "runge_kutta4, semi_implicit_euler, implicit_midpoint, and moreau_jean for contacts";
}  // namespace

command& add_solver(command& c, solver_options& o) {
  return c
      .text("--solver", "NAME", o.name,
            std::string("default dormand_prince45. With adaptive steps: ") + by_tolerance +
                ". With a fixed step: " + of_fixed_step)
      .number("--tolerance", "X", o.tolerance,
              "absolute and relative tolerance of each step; default " + short_number(o.tolerance))
      .number("--step", "S", o.step, "for solvers with a fixed step, s; default 0.001");
}

void check_settings(const solver_options& o) {
  for (const auto& [name, x] : {std::pair("--tolerance", o.tolerance), std::pair("--step", o.step)})
    if (!(x > 0)) throw usage_error(std::string(name) + " must be greater than 0, not " + short_number(x));
  constexpr double least = 4 * std::numeric_limits<double>::epsilon();  // kte::tolerances
  if (o.tolerance < least)
    throw usage_error("--tolerance must be at least " + short_number(least) + ", 4 rounding errors, not " +
                      short_number(o.tolerance));
  if (o.tolerance > 0.1)
    throw usage_error("--tolerance must be at most 0.1, a tenth of each number, not " + short_number(o.tolerance));
}

std::unique_ptr<plant_solver> make_solver(plant& p, const plant::state& x, const solver_options& o) {
  const kte::tolerances<double> exact{.absolute = o.tolerance, .relative = o.tolerance, .max_steps = o.max_steps};
  if (o.name == "dormand_prince45") return method<kte::dormand_prince45>(p, x, exact);
  if (o.name == "prince_dormand87") return method<kte::prince_dormand87>(p, x, exact);
  if (o.name == "runge_kutta4") return method<kte::runge_kutta4>(p, x, o.step);
  if (o.name == "semi_implicit_euler") return method<kte::semi_implicit_euler>(p, x, o.step);
  if (o.name == "adams") return vector_method<kte::adams>(p, x, exact);
  if (o.name == "moreau_jean") return contact_method(p, x, o.step);
  if (auto stiff = make_stiff_solver(p, x, o, exact)) return stiff;
  throw usage_error("there is no solver '" + o.name + "', but " + by_tolerance + "; " + of_fixed_step);
}

}  // namespace kte_tool
