#pragma once

#include <kte/events/events.hpp>
#include <kte/integrators/integrator.hpp>
#include <kte/integrators/tolerances.hpp>
#include <kte/models/modes.hpp>
#include <kte/models/vector_form.hpp>

#include <memory>
#include <span>

#include "simulate/plant.hpp"

namespace kte_python {

using kte_tool::plant;

/// The functions of the program that a simulation calls, of states (q, v, z).
class callbacks {
 public:
  virtual ~callbacks() = default;
  /// g of an event.
  virtual double value(std::size_t event, double t, const plant::state& x) = 0;
  /// The reset of an event.
  virtual void reset(std::size_t event, double t, plant::state& x) = 0;
};
/// g of an event, to be copied freely.
struct event_value {
  callbacks* all;
  std::size_t event;
  double operator()(double t, const plant::state& x) const { return all->value(event, t, x); }
};
/// The reset of an event.
struct event_reset {
  callbacks* all;
  std::size_t event;
  void operator()(double t, plant::state& x) const { all->reset(event, t, x); }
};
using plain_event = kte::event<event_value>;
using acting_event = kte::event<event_value, event_reset>;

/// Events of a program, without and with resets.
struct event_lists {
  std::vector<plain_event> plain;
  std::vector<acting_event> acting;
};

/// Where a solver is observed: after every step, or at these times; in both cases also before and after events.
struct sampling {
  bool every_step = false;
  std::span<const double> times{};
};
using observer = std::function<void(double t, const plant::state& x)>;
using report = kte::event_report<plant::state>;

/// A solver of a plant, whatever its method.
class any_solver {
 public:
  virtual ~any_solver() = default;
  virtual report advance(double end, const event_lists& events, const sampling& at, const observer& observe) = 0;
  virtual double time() const = 0;
  virtual const plant::state& state() const = 0;
  virtual void restart(double t, const plant::state& x) = 0;
  virtual kte::step_statistics statistics() const = 0;
  /// The state of the chain at t and x of an observer, of solvers whose steps have contact forces; otherwise nullptr.
  virtual const kte::runtime_state* state_at(double, const plant::state&) { return nullptr; }
};

struct solver_options {
  std::string name;
  double step;
  kte::tolerances<double> tolerances;
};

/// A solver; null if there is none of this name.
std::unique_ptr<any_solver> make_explicit_solver(plant& p, const plant::state& x, double t, const solver_options& o);
std::unique_ptr<any_solver> make_stiff_solver(plant& p, const plant::state& x, double t, const solver_options& o);
std::unique_ptr<any_solver> make_fixed_step_solver(plant& p, const plant::state& x, double t, const solver_options& o);
std::unique_ptr<any_solver> make_contact_solver(plant& p, const plant::state& x, double t, const solver_options& o);
/// Throws `bad_argument` if there is no solver of this name.
void check_solver(const std::string& name);
/// The solver of this name, from q and v on, where the modes of elements have settled. Throws `bad_argument` if there
/// is none.
std::unique_ptr<any_solver> start_solver(plant& p, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t,
                                         const solver_options& o);
/// The times from begin to end with this spacing, and the end.
std::vector<double> even_times(double begin, double end, double spacing);
/// The names of all solvers.
inline constexpr const char* solvers_with_tolerances =
    "dormand_prince45, prince_dormand87, adams, bdf, rodas, rosenbrock23, "
    "kennedy_carpenter34, tr_bdf2, trapezoidal";
inline constexpr const char* solvers_of_fixed_step =
    "runge_kutta4, runge_kutta5, euler, midpoint, semi_implicit_euler, implicit_midpoint, moreau_jean";

}  // namespace kte_python
