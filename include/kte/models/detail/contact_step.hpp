#pragma once

#include <kte/dynamics/contacts/mode_dynamics.hpp>
#include <kte/dynamics/contacts/strike.hpp>

#include <algorithm>
#include <string>
#include <vector>

/// What a model with rigid contacts keeps from one evaluation in a step to the next.
namespace kte::detail {

/// Heights that events do not resolve, relative to the length of the chain.
inline constexpr double unresolved_height = 1e-13;

/// The functions of a contact that pass through zero at its events, and the time that slow sliding looks ahead.
struct contact_margin {
  double touch = 1;       ///< the gap of an open contact, m; the normal force of a closed one, N
  double friction = 1;    ///< of one that sticks its reserve of friction, N; of one that slides its speed, m/s
  double turn = 1;        ///< whether it slides in the direction in which sliding began, m/s
  double look_ahead = 0;  ///< tau of slow_sliding.hpp, s
  bool is_least = false;  ///< whether other forces than those of least norm satisfy the laws, and these do not

  /// The function of event `part` of the contact.
  double at(int part) const { return part == 0 ? touch : part == 1 ? friction : turn; }
};
/// Events of one contact at one time that have changed nothing. Where there are several, a force crosses zero within
/// its rounding errors, which differ between the event and what is decided there.
struct idle_events {
  double time = 0;
  int contact = -1, count = 0;

  /// Eight is a choice: any number below the repeats that need a bridge (`repeats_of_elements`, 100) would do.
  bool are_many(double t, int of) const { return contact == of && time == t && count >= 8; }
  void note(double t, int of, bool changes) {
    if (changes || contact != of || time != t) count = 0;
    time = t, contact = of, count += !changes;
  }
};
struct contact_step {
  contact_step(const chain_constraints& c, const runtime_state& s) : at(c, s) {}

  Eigen::VectorXd x0;
  double time = 0;        ///< of the states that `settle_contacts` puts on the rows
  double start_time = 0;  ///< of x0
  contact_solver at;      ///< at x0
  mode_rows gaps, rates;  ///< at x0
  std::vector<int> chosen_gaps;
  std::vector<char> keeps;  ///< whether the step keeps a closure, or a contact, closed; by closure
  forces_in_modes forces;
  mode_rows working;
  Eigen::VectorXd values;
  bool all_open = true;
  int begun = 0;                  ///< steps since the last event
  bool starts_wrong = false;      ///< whether modes are wrong at x0
  Eigen::VectorXd wrong;          ///< the last state where modes are wrong
  std::vector<double> zero_gaps;  ///< gaps after the last event, by contact, where they count as zero

  impact_memory impacts;
  std::string change;  ///< what the last event changed
  idle_events idle;
  Eigen::VectorXd margin_x;
  double margin_time = 0;
  double largest_force = 0;  ///< of contacts since the last event, N; at an event it may itself be zero
  std::vector<contact_margin> margins;
  Eigen::VectorXd inputs;  ///< of the model, for `margins`

  /// The speed below which sliding is slow, for a tolerance, m/s or m: places change by its square where sliding stops
  /// and where it begins, and it must be above the noise of the integration.
  void let_tolerate(double absolute) {
    const double relative = absolute / at.equations.places.length;
    forces.slow_speed = (std::min)((std::max)(10 * std::sqrt(relative), 150 * relative), 1e-2);
    margin_x.resize(0);
  }
  /// Forgets margins that were computed with other inputs of the model.
  void take_inputs(const Eigen::VectorXd& u) {
    if (inputs.size() == u.size() && inputs == u) return;
    inputs = u, margin_x.resize(0);
  }
};

}  // namespace kte::detail
