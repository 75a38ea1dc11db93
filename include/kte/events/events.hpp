#pragma once

#include <kte/events/detail/event_loop.hpp>
#include <kte/integrators/integrator.hpp>

/// Integration with events: functions g(t, x) of the solution whose zeros are found, reported and acted upon. With
/// every integrator. How it works and what is guaranteed: docs/events.md.
namespace kte {

namespace detail {
/// `integrator::integrate` with events.
template <class Solver, class Sink, class... E, class... Observed>
auto integrate_with_events(Solver& solver, const typename Solver::S& t_end, event_list<Sink, E...> events,
                           Observed&&... observed) {
  static_assert(!is_pack<typename std::remove_cvref_t<decltype(solver.state())>::Scalar>,
                "kte: lanes of a pack have events at different times; integrate states with events one by one");
  decltype(auto) follower = follower_of(solver, t_end, observed...);
  return event_loop<Solver, event_list<Sink, E...>, decltype(follower)>(solver, t_end, events,
                                                                        static_cast<decltype(follower)>(follower))
      .run();
}
}  // namespace detail

}  // namespace kte
