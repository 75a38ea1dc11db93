#pragma once

#include <kte/dynamics/frame_motion.hpp>
#include <kte/runtime_chain.hpp>

#include <string_view>

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

/// Registers further operations, whose references only the textbook has.
template <class Model>
void add_more_of_runtime() {
  namespace calls = runtime_calls;
  const auto add = [](operation o, call<double> f) { bench::add(o, "runtime", Model::name, f); };
  add(operation::frames, call_on<Model, calls::frames>);
  add(operation::kinetic_energy, call_on<Model, calls::kinetic_energy>);
  add(operation::potential_energy, call_on<Model, calls::potential_energy>);
  add(operation::gravity_forces, call_on<Model, calls::gravity_forces>);
  add(operation::coriolis_matrix, call_on<Model, calls::coriolis_matrix>);
  add(operation::jacobian_rate, call_on<Model, calls::jacobian_rate>);
  add(operation::com_jacobian, call_on<Model, calls::com_jacobian>);
  add(operation::momentum_matrix, call_on<Model, calls::momentum_matrix>);
  add(operation::momentum_rate, call_on<Model, calls::momentum_rate>);
}

}  // namespace bench
