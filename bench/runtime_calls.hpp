#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/runtime_chain.hpp>

#include <string_view>

#include "further_operations.hpp"
#include "timing.hpp"

namespace bench {

/// A runtime chain, its tool, and a state that stays where it is, as in a control loop.
struct runtime_subject {
  runtime_subject(kte::runtime_chain c, std::string_view tool_name, bool is_planar = false)
      : chain(std::move(c)), tool(chain.frame(tool_name)), planar(is_planar) {}
  kte::runtime_chain chain;
  kte::handle tool;
  bool planar;
  kte::runtime_state state = chain.make_state();
  int nq = chain.nq(), nv = chain.dofs();
};

/// The algorithms, compiled once for all chains. Jacobians go where they are needed; the others give references into
/// the state, from which results are copied as an application would that keeps them.
namespace runtime_calls {
using function = void(runtime_subject&, const double* x, double* y);
function passes, forward_kinematics, jacobian, inverse_dynamics, nonlinear_effects, mass_matrix, forward_dynamics,
    mass_matrix_inverse, id_derivatives, fd_derivatives, regressor, frames, kinetic_energy, potential_energy,
    gravity_forces, coriolis_matrix, jacobian_rate, com_jacobian, momentum_matrix, momentum_rate;
}  // namespace runtime_calls

template <class Model, runtime_calls::function* F>
void call_on(const double* x, double* y) {
  F(Model::made(), x, y);
}

/// Registers them for the subject that is `Model::made()`.
template <class Model>
void add_runtime() {
  namespace calls = runtime_calls;
  const auto add = [](operation o, call<double> f) { bench::add(o, "runtime", Model::name, f); };
  add(operation::passes, call_on<Model, calls::passes>);
  add(operation::forward_kinematics, call_on<Model, calls::forward_kinematics>);
  add(operation::jacobian, call_on<Model, calls::jacobian>);
  add(operation::inverse_dynamics, call_on<Model, calls::inverse_dynamics>);
  add(operation::nonlinear_effects, call_on<Model, calls::nonlinear_effects>);
  add(operation::mass_matrix, call_on<Model, calls::mass_matrix>);
  add(operation::forward_dynamics, call_on<Model, calls::forward_dynamics>);
  if (Model::made().nv > 32) return;  // results grow by the square, their references take still longer
  add(operation::mass_matrix_inverse, call_on<Model, calls::mass_matrix_inverse>);
  add(operation::id_derivatives, call_on<Model, calls::id_derivatives>);
  add(operation::fd_derivatives, call_on<Model, calls::fd_derivatives>);
}

/// The further operations for the subject that is `Model::made()`.
template <class Model>
struct further_runtime_calls {
  template <runtime_calls::function* F>
  static constexpr call<double> of = call_on<Model, F>;
  static constexpr auto frames = of<runtime_calls::frames>, kinetic_energy = of<runtime_calls::kinetic_energy>,
                        potential_energy = of<runtime_calls::potential_energy>,
                        gravity_forces = of<runtime_calls::gravity_forces>,
                        coriolis_matrix = of<runtime_calls::coriolis_matrix>,
                        jacobian_rate = of<runtime_calls::jacobian_rate>,
                        com_jacobian = of<runtime_calls::com_jacobian>,
                        momentum_matrix = of<runtime_calls::momentum_matrix>,
                        momentum_rate = of<runtime_calls::momentum_rate>;
};

}  // namespace bench
