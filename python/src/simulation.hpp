#pragma once

#include <map>
#include <optional>
#include <pybind11/pybind11.h>

#include "coordinate_forces.hpp"
#include "gates.hpp"
#include "recording.hpp"
#include "signal_watch.hpp"
#include "solvers.hpp"

namespace kte_python {

/// kte.Simulation: a chain, forces on its coordinates and inputs by functions of the program, and a solver.
class simulation : public callbacks {
 public:
  /// `drawn` is what the program simulates; `gates` has functions of the contacts that they let land. `control_every`:
  /// the time between calls of control, s; 0: when the solver needs it. `holds_control`: control is evaluated at the
  /// begin of each step alone.
  simulation(py::object drawn, kte::runtime_chain c, py::object control, double control_every, const py::dict& inputs,
             const py::list& events, const py::dict& gates, bool of_time_alone, bool holds_control);
  simulation(const simulation&) = delete;
  simulation& operator=(const simulation&) = delete;

  /// Makes the solver. Throws `bad_argument` if there is none of this name.
  void start(const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t, const solver_options& o);
  void set_control(py::object control);
  void set_inputs(const py::dict& inputs);
  py::object advance(double end, py::handle every, py::handle at);

  double time() const { return solver_->time(); }
  const plant::state& state() const { return solver_->state(); }
  kte::step_statistics statistics() const { return solver_->statistics(); }
  py::object recording() const { return recording_; }
  std::pair<py::object, py::object> q_and_v(const plant::state& x) const;

  // Called without the GIL.
  double value(std::size_t event, double t, const plant::state& x) override;
  void reset(std::size_t event, double t, plant::state& x) override;

 private:
  struct input_law {
    std::string name;
    Eigen::Index u;
    int count;
    py::object function;
  };
  struct event_of_program {
    py::object event, function, reset;
    std::string name;
    kte::crossing direction;
    bool terminal, one_sided;
  };

  /// The gates of contacts, as functions for the chain.
  std::map<std::string, gate> gates_of(const py::dict& functions);
  bool admits(const std::string& contact, double t, const kte::runtime_state& s) const;
  void law(double t, const plant::state& x, Eigen::VectorXd& u);
  Eigen::VectorXd moving_part(const plant::state& x) const {
    return x.head(plant_.model().nq() + plant_.model().dofs());
  }
  /// Functions are called once for equal t, q and v, until this.
  void forget_calls() { now_.reset(), last_.reset(), inputs_at_.reset(); }
  /// The forces of control. Held ones are those at the begin of the step that contains t.
  const Eigen::VectorXd& forces_at(double t, const plant::state& x);
  Eigen::VectorXd control_at(double t, const plant::state& x) const;
  std::vector<double> times_from(double end, py::handle every, py::handle at) const;
  bool is_sampled() const { return control_every_ > 0 && !control_.is_none(); }
  double next_sample() const { return begin_ + static_cast<double>(samples_) * control_every_; }
  /// Calls a sampled control if it is time, and returns when the next call is due, or `end` if that is before.
  double sample_control(double end);

  py::object drawn_, recording_ = py::none(), control_ = py::none();
  bool has_forces_;
  coordinate_forces forces_;
  kte::runtime_chain chain_;  ///< of recordings: with the forces, without gates
  std::map<std::string, py::object> gates_;
  plant plant_;
  Eigen::VectorXd u_, tau_;
  std::vector<input_law> laws_;
  std::vector<event_of_program> events_;
  event_lists lists_;
  std::unique_ptr<any_solver> solver_;
  /// A call of control or of the functions of inputs.
  struct sample {
    double t;
    Eigen::VectorXd moving, tau;  ///< q and v, and the forces of control
    bool is_of(double at, const Eigen::VectorXd& q_and_v) const { return t == at && moving == q_and_v; }
  };
  double control_every_, begin_ = 0;
  long long samples_ = 0;  ///< of control, so far
  bool holds_control_;
  std::optional<sample> now_, last_, inputs_at_;  ///< the last call of control and the one before; of inputs
  signal_watch watch_;
  bool running_ = false;
};

}  // namespace kte_python
