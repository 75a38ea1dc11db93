#pragma once

#include <string>

#include "argument_names.hpp"

/// The parts of the module kte._kte.
namespace kte_python {

/// A message of C++ with the names of Python.
std::string in_python(std::string what);

void bind_errors(pybind11::module_& m);
void bind_arrays(pybind11::module_& m);
void bind_chain(pybind11::module_& m);
void bind_dynamics(pybind11::module_& m);
void bind_derivatives(pybind11::module_& m);
void bind_frames(pybind11::module_& m);
void bind_momentum(pybind11::module_& m);
void bind_configurations(pybind11::module_& m);
void bind_contacts(pybind11::module_& m);
void bind_loops(pybind11::module_& m);
void bind_state(pybind11::module_& m);
void bind_files(pybind11::module_& m);
void bind_robots(pybind11::module_& m);
void bind_inverse_kinematics(pybind11::module_& m);
void bind_simulation(pybind11::module_& m);
void bind_compiled(pybind11::module_& m);
void bind_sweep_cases(pybind11::module_& m);
void bind_sweep(pybind11::module_& m);
void bind_joint_motions(pybind11::module_& m);
void bind_statics(pybind11::module_& m);
void bind_rollout(pybind11::module_& m);
void bind_control(pybind11::module_& m);
void bind_view(pybind11::module_& m);

}  // namespace kte_python
