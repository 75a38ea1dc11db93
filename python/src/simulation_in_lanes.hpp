#pragma once

#include <kte/integrators/tolerances.hpp>
#include <kte/runtime_chain/runtime_chain.hpp>
#include <kte/sweep/sweep_cases.hpp>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "signal_watch.hpp"

namespace kte_python {

/// The numbers in which a case differs from others: values of parameters, the start, forces on coordinates, inputs.
struct lane_numbers {
  std::vector<double> parameters;
  Eigen::VectorXd q, v, tau, u;
};

/// A simulation of many cases in the lanes of packs, with their own times and steps.
struct simulation_in_lanes {
  const kte::runtime_chain& chain;
  const std::vector<std::string>& paths;  ///< of the parameters that vary
  std::string solver;
  double begin, end, step;
  kte::tolerances<double> tolerances;
  std::function<lane_numbers(std::uint64_t index)> numbers_of_case;
  const std::atomic<bool>& stop;
};

/// Whether simulations of a chain by a solver can be computed in lanes: the solver is dormand_prince45 or
/// runge_kutta4, and the state of the chain consists of numbers q and v alone, without events of elements, closures,
/// contacts, or the time as a signal.
bool can_be_in_lanes(const kte::runtime_chain& c, const std::string& solver);
/// The final states (q, v) of the cases from `first` to `last`, exclusive; empty for a case that fails.
std::vector<std::vector<double>> final_states(const simulation_in_lanes& s, const kte::sweep_cases& cases,
                                              std::uint64_t first, std::uint64_t last);

/// The arrays of rollouts: starts, forces by rollout and step, and states by rollout and row, one more than steps.
struct rollout_arrays {
  std::size_t count, steps;
  const double *q0, *v0, *tau;
  double *q, *v;
};
/// Motions under forces that are constant for `every`, s, each, by runge_kutta4, in the lanes of packs.
void rollouts_in_lanes(const kte::runtime_chain& c, const rollout_arrays& x, double every, double step,
                       const interruptible_threads& team);

}  // namespace kte_python
