#pragma once

#include <kte/integrators/time_grid.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "simulate/plant.hpp"

namespace kte_tool {

/// How a mechanism is integrated, as the command line says.
struct solver_options {
  std::string name = "dormand_prince45";
  double tolerance = 1e-9, step = 1e-3;  ///< the step, s, is of solvers of a fixed one
  long long max_steps = 1'000'000'000;   ///< from one call of `advance` to the next
};
/// --solver, --tolerance and --step.
command& add_solver(command& c, solver_options& o);
/// Throws `usage_error` for numbers that is invalid.
void check_settings(const solver_options& o);

/// Called at evenly spaced times.
using run_observer = std::function<void(double t, const plant::state& x)>;

/// An event: time, s, the element, and what has changed, for contacts.
struct past_event {
  double time;
  std::string element, what;
};

/// A solver of a plant, whatever its method.
class plant_solver {
 public:
  virtual ~plant_solver() = default;
  /// To a time, with events where the laws of elements change; calls an observer at the times of rows, also at
  /// both ends. Throws what integrators throw.
  virtual void advance(double end, const kte::every<double>& rows, const run_observer& observe) = 0;
  virtual double time() const = 0;
  virtual const plant::state& state() const = 0;
  /// The state of the chain at t and x of an observer.
  virtual const kte::runtime_state& state_at(double t, const plant::state& x) = 0;
  virtual kte::step_statistics statistics() const = 0;
  long long events() const { return events_; }
  /// Keeps a list of the events from now on.
  void keep_events() { keeps_events_ = true; }
  const std::vector<past_event>& kept_events() const { return kept_; }

 protected:
  void add_event(const past_event& e) {
    ++events_;
    if (keeps_events_) kept_.push_back(e);
  }

 private:
  long long events_ = 0;
  bool keeps_events_ = false;
  std::vector<past_event> kept_;
};

/// From x at t = 0. Throws `usage_error` for a solver that there is not. The plant must outlive it.
std::unique_ptr<plant_solver> make_solver(plant& p, const plant::state& x, const solver_options& o);

}  // namespace kte_tool
