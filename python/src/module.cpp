#include "parts.hpp"

PYBIND11_MODULE(_kte, m) {
  namespace py = pybind11;
  py::options options;
  options.disable_function_signatures();
  m.doc() = "The compiled part of kte.";
  m.attr("__version__") = KTE_VERSION;
  kte_python::bind_errors(m);
  kte_python::bind_arrays(m);
  kte_python::bind_chain(m);
  kte_python::bind_dynamics(m);
  kte_python::bind_derivatives(m);
  kte_python::bind_momentum(m);
  kte_python::bind_frames(m);
  kte_python::bind_configurations(m);
  kte_python::bind_loops(m);
  kte_python::bind_contacts(m);
  kte_python::bind_state(m);
  kte_python::bind_files(m);
  kte_python::bind_robots(m);
  kte_python::bind_inverse_kinematics(m);
  kte_python::bind_joint_motions(m);
  kte_python::bind_statics(m);
  kte_python::bind_simulation(m);
  kte_python::bind_compiled(m);
  kte_python::bind_sweep_cases(m);
  kte_python::bind_sweep(m);
  kte_python::bind_view(m);
}
