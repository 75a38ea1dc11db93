#pragma once

#include <kte/models/runtime_dynamics_model.hpp>

#include <algorithm>
#include <memory>
#include <pybind11/pybind11.h>
#include <span>
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

/// Which rows of a recording: those that the program asked for, or also those before and after events.
enum class row_choice { asked, all };

/// kte.Recording: states x = (q, v, z) and inputs u of a chain over time. Other quantities are computed from them.
struct recording_object {
  kte::runtime_chain chain;
  py::object drawn;  ///< what `view` shows: the chain or robot that was simulated
  std::size_t nx = 0, nu = 0;
  std::vector<double> t, x, u;  ///< of all rows, one after the other
  std::vector<char> asked;      ///< of each row, whether the program asked for it
  /// Of solvers whose steps have contact forces: accelerations, and the contacts, row after row.
  std::vector<double> accelerations;
  std::vector<kte::contact_state<>> contacts;
  std::vector<happened> events;
  std::string reason = "end_time", stopped_by;
  kte::step_statistics statistics;

  std::size_t rows(row_choice which) const {
    return which == row_choice::all ? t.size() : static_cast<std::size_t>(std::count(asked.begin(), asked.end(), 1));
  }
  bool has(row_choice which, std::size_t row) const { return which == row_choice::all || asked[row] != 0; }
  void add_time(double now) { t.push_back(now), asked.push_back(1); }
  /// A row at time `now` was asked for if the next of `times`, which grow or decrease like those of rows, is `now`. If
  /// there are several rows at one time, the last ones were asked for, which have the states after events.
  void add_time(double now, std::span<const double> times) {
    add_time(now);
    if (next_ < times.size() && times[next_] == now) return void(++next_);
    std::size_t first = t.size();
    for (std::size_t i = t.size(); i-- > 0 && t[i] == now;)
      if (asked[i] != 0) first = i;
    asked[first] = 0;
  }
  Eigen::VectorXd state(std::size_t row) const {
    return Eigen::Map<const Eigen::VectorXd>(x.data() + row * nx, static_cast<Eigen::Index>(nx));
  }
  Eigen::VectorXd input(std::size_t row) const {
    return Eigen::Map<const Eigen::VectorXd>(u.data() + row * nu, static_cast<Eigen::Index>(nu));
  }
  /// visit(t, state of the chain) for the rows, with all frames and forces; without the GIL.
  template <class Visit>
  void replay(row_choice which, const Visit& visit) const {
    kte::manipulator_dynamics_model model(chain);
    if (!accelerations.empty()) return replay_with_contacts(model, which, visit);
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (!has(which, i)) continue;
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
  std::size_t next_ = 0;  ///< of the times asked for

  int contact_count() const { return chain.wiring().count(kte::kind::contact); }
  template <class Visit>
  void replay_with_contacts(kte::manipulator_dynamics_model<kte::runtime_chain>& model, row_choice which,
                            const Visit& visit) const {
    kte::runtime_state s = chain.make_state();
    const auto n = static_cast<std::size_t>(model.dofs()), count = static_cast<std::size_t>(contact_count());
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (!has(which, i)) continue;
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
