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
  std::string what;               ///< what has changed, for contacts
};

/// kte.Recording: states x = (q, v, z) and inputs u of a chain over time. Other quantities are computed from them.
struct recording_object {
  kte::runtime_chain chain;
  py::object drawn;  ///< what `view` shows: the chain or robot that was simulated
  std::size_t nx = 0, nu = 0;
  std::vector<double> t, x, u;  ///< one after the other
  /// Of solvers whose steps have contact forces: accelerations, and the contacts, row after row.
  std::vector<double> accelerations;
  std::vector<kte::contact_state<>> contacts;
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
    if (!accelerations.empty()) return replay_with_contacts(model, visit);
    for (std::size_t i = 0; i < rows(); ++i) {
      model.setInput(input(i));
      visit(t[i], model.state_at(t[i], state(i)));
    }
  }
  /// Adds the accelerations and contacts of a state to those of the last row.
  void add(const kte::runtime_state& s) {
    const Eigen::VectorXd a = kte::accelerations(s);
    accelerations.insert(accelerations.end(), a.data(), a.data() + a.size());
    for (int i = 0; i < contact_count(); ++i) contacts.push_back(s.get<kte::kind::contact>(i));
  }

 private:
  int contact_count() const { return chain.wiring().count(kte::kind::contact); }
  template <class Visit>
  void replay_with_contacts(kte::manipulator_dynamics_model<kte::runtime_chain>& model, const Visit& visit) const {
    kte::runtime_state s = chain.make_state();
    const auto n = static_cast<std::size_t>(model.dofs()), count = static_cast<std::size_t>(contact_count());
    for (std::size_t i = 0; i < rows(); ++i) {
      model.setInput(input(i)), model.setJointStates(t[i], state(i), s);
      kte::set_accelerations(s, Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(accelerations.data() + i * n,
                                                                                  static_cast<Eigen::Index>(n))));
      for (std::size_t k = 0; k < count; ++k) s.get<kte::kind::contact>(static_cast<int>(k)) = contacts[i * count + k];
      chain.doMotion(s), chain.clearForce(s), chain.doForce(s);
      visit(t[i], s);
    }
  }
};

/// The state of a pickle of a recording, and the recording.
py::tuple state_of(const recording_object& r);
std::unique_ptr<recording_object> recording_from(const py::tuple& state);
/// Counts of a solver: a dict.
py::dict statistics_of(const kte::step_statistics& s);

}  // namespace kte_python
