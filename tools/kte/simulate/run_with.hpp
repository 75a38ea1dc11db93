#pragma once

#include <kte/io/progress.hpp>
#include <kte/io/progress_bar.hpp>

#include "simulate/solvers.hpp"

namespace kte_tool {

/// A run by a solver that stands at the start: with a bar on terminals, and events where the laws of elements change.
template <class Solver>
run_result run_with(Solver& solver, plant& p, plant::state& x, const run_settings& s, const run_observer& observe) {
  kte::progress report(0.0, s.end, kte::progress_bar());
  run_result out;
  const auto of_model = kte::element_events(p.model());
  const auto changes =
      kte::events(kte::detail::event_under_law(p, std::get<0>(of_model.list))).report_to([&out](const auto&) {
        ++out.events;
      });
  solver.integrate(s.end, changes, kte::every(s.every), [&](double t, const plant::state& at) {
    observe(t, at);
    report(t);
  });
  x = solver.state();
  out.statistics = solver.statistics();
  return out;
}

/// A method of a family, made at the start.
template <template <class, class> class Method, class F, class How>
run_result run_method(F f, plant& p, plant::state& x, const run_settings& s, const run_observer& observe,
                      const How& how) {
  Method<F, plant::state> solver(std::move(f), 0.0, x, how);
  return run_with(solver, p, x, s, observe);
}

}  // namespace kte_tool
