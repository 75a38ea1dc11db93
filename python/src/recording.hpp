#pragma once

#include <kte/models/runtime_dynamics_model.hpp>

#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace kte_python {

namespace py = pybind11;

/// An event that has happened.
struct happened {
  std::string name;
  double time;
  Eigen::VectorXd before, after;  ///< states x of the model
};

/// kte.Recording: states x = (q, v, z) and inputs u of a chain over time. Other quantities are computed from them.
struct recording_object {
  kte::runtime_chain chain;
  py::object drawn;  ///< what `view` shows: the chain or robot that was simulated
  std::size_t nx = 0, nu = 0;
  std::vector<double> t, x, u;  ///< one after the other
  std::vector<happened> events;
  std::string reason = "end_time", stopped_by;
  kte::step_statistics statistics;

  std::size_t rows() const { return t.size(); }
  Eigen::VectorXd state(std::size_t row) const {
    return Eigen::Map<const Eigen::VectorXd>(x.data() + row * nx, static_cast<Eigen::Index>(nx));
  }
  Eigen::VectorXd input(std::size_t row) const {
    return Eigen::Map<const Eigen::VectorXd>(u.data() + row * nu, static_cast<Eigen::Index>(nu));
  }
  /// visit(t, state of the chain) for all rows, with all frames and forces; without the GIL.
  template <class Visit>
  void replay(const Visit& visit) const {
    kte::manipulator_dynamics_model model(chain);
    for (std::size_t i = 0; i < rows(); ++i) {
      model.setInput(input(i));
      visit(t[i], model.state_at(t[i], state(i)));
    }
  }
};

/// Counts of a solver: a dict.
py::dict statistics_of(const kte::step_statistics& s);

}  // namespace kte_python
