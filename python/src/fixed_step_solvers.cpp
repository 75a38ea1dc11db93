#include <kte/integrators/euler.hpp>
#include <kte/integrators/implicit_midpoint.hpp>
#include <kte/integrators/midpoint.hpp>
#include <kte/integrators/runge_kutta4.hpp>
#include <kte/integrators/runge_kutta5.hpp>
#include <kte/integrators/semi_implicit_euler.hpp>

#include "method.hpp"

namespace kte_python {

std::unique_ptr<any_solver> make_fixed_step_solver(plant& p, const plant::state& x, double t, const solver_options& o) {
  if (o.name == "runge_kutta4") return solver_of<kte::runge_kutta4>(p, x, t, o.step);
  if (o.name == "runge_kutta5") return solver_of<kte::runge_kutta5>(p, x, t, o.step);
  if (o.name == "euler") return solver_of<kte::euler>(p, x, t, o.step);
  if (o.name == "midpoint") return solver_of<kte::midpoint>(p, x, t, o.step);
  if (o.name == "semi_implicit_euler") return solver_of<kte::semi_implicit_euler>(p, x, t, o.step);
  if (o.name == "implicit_midpoint") return solver_of<kte::implicit_midpoint>(p, x, t, o.step);
  return nullptr;
}

}  // namespace kte_python
