#pragma once

#include <kte/events/detail/event_loop.hpp>
#include <kte/integrators/integrator.hpp>

/// Integration with events: functions g(t, x) of the solution whose zeros are found, reported and acted upon. With
/// every integrator. How it works and what is guaranteed: docs/events.md.
namespace kte {

/// Integrates to t_end, or to a terminal event, whose time and state are those of the solver then.
///
///   auto ground = kte::event(height, kte::crossing::falling).reset(bounce).rest(lie);
///   auto report = kte::integrate(solver, 10.0, kte::events(ground, wall));
///
/// Throws what `solver.integrate` throws, and `integration_failure` for a g that is not a finite number.
template <class Solver, class Sink, class... E>
auto integrate(Solver& solver, const typename Solver::S& t_end, event_list<Sink, E...> events) {
  return detail::event_loop<Solver, event_list<Sink, E...>, detail::no_observer>(solver, t_end, events, {}).run();
}
/// The same; calls observer(t, x) at the start, after every step, and at events that act: with the state before and,
/// where there is a reset, again with the state after it. Events that do not act leave the steps as they are.
template <class Solver, class Sink, class... E, class Observer>
auto integrate(Solver& solver, const typename Solver::S& t_end, event_list<Sink, E...> events, Observer&& observer) {
  using step_observer = detail::step_observer<std::remove_reference_t<Observer>>;
  return detail::event_loop<Solver, event_list<Sink, E...>, step_observer>(solver, t_end, events,
                                                                           step_observer(observer))
      .run();
}
/// The same; calls observer(t, x) at the times of a `time_grid` from the start to t_end, and at events that act, with
/// the states before and after. A sample at the very time of such an event is these two.
template <class Solver, class Sink, class... E, class T, class Observer>
auto integrate(Solver& solver, const typename Solver::S& t_end, event_list<Sink, E...> events, const every<T>& spacing,
               Observer&& observer) {
  using S = typename Solver::S;
  using X = std::remove_cvref_t<decltype(solver.state())>;
  using samples = detail::sample_observer<S, X, std::remove_reference_t<Observer>>;
  detail::check_finite(t_end, "end time");
  return detail::event_loop<Solver, event_list<Sink, E...>, samples>(
             solver, t_end, events, samples(solver.time(), solver.state(), t_end, S(spacing.spacing), observer))
      .run();
}

}  // namespace kte
