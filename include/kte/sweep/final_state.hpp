#pragma once

#include <kte/integrators/integrator.hpp>
#include <kte/sweep/sweep_case.hpp>

namespace kte {

/// A ready-made function of a sweep: integrates a case to t_end and keeps the final state. start(c) returns the solver
/// of a case; with packs (`in_packs`), an explicit Runge-Kutta method on states of packs.
///
///   const auto start = [](const auto& c) { return kte::runge_kutta4(swing{c["length"]}, 0.0, x0, 0.01); };
///   kte::sweep s(cases, {"angle", "speed"}, kte::final_state(10.0, start));
template <class Start>
[[nodiscard]] auto final_state(double t_end, Start start) {
  return [t_end, start = std::move(start)](const auto& c) {
    auto solver = start(c);
    solver.integrate(t_end);
    return solver.state();
  };
}

}  // namespace kte
