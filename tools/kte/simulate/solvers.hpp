#pragma once

#include <optional>
#include <string>

#include "simulate/plant.hpp"

namespace kte_tool {

struct run_settings {
  std::string solver;
  double end = 10, tolerance = 1e-9, step = 1e-3, every = 0.01;  ///< s but for the tolerance
};
struct run_result {
  kte::step_statistics statistics;
  long long events = 0;
};
/// Called at evenly spaced times.
using run_observer = std::function<void(double t, const plant::state& x)>;

/// From 0 to the end, from x, which then is the state there. Throws `usage_error` for a solver that there is not, and
/// what integrators throw.
run_result run(plant& p, plant::state& x, const run_settings& s, const run_observer& observe);

/// Their names: those that choose their steps by the tolerance, and those of a fixed step.
extern const char* const solvers_by_tolerance;
extern const char* const solvers_of_fixed_step;

}  // namespace kte_tool
