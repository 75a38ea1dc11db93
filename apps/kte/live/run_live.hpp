#pragma once

#include "commands.hpp"
#include "mechanism.hpp"
#include "simulate/solvers.hpp"
#include "start.hpp"

namespace kte_tool {

struct live_settings {
  reading in;
  bool open = false;
  double port = 0, speed = 1;
  start_options start;
  solver_options solver{.tolerance = 1e-6, .max_steps = 20000};  ///< from one picture to the next
  std::optional<double> end;                                     ///< s
};

/// Simulates in real time until it is interrupted; the exit code. Throws where it cannot be served.
int run_live(const live_settings& o);

}  // namespace kte_tool
