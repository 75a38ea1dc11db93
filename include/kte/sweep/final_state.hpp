#pragma once

#include <kte/sweep/detail/lane_queue.hpp>
#include <kte/sweep/sweep_case.hpp>

#include <utility>

namespace kte {

namespace detail {
struct no_events {};
/// Keeps the state at the end.
struct keep_state {
  template <class End>
  const auto& operator()(const End& end) const {
    require_no_zeno(end.reason, as_double(end.time), end.stopped_by);
    return end.state;
  }
};
}  // namespace detail

/// The end of a simulation. X: a state in numbers; with packs whose lanes have common steps, a state in packs.
template <class X>
struct simulation_end {
  detail::time_scalar<typename X::Scalar> time{};  ///< s
  X state;
  long long events = 0;                        ///< number of events
  stop_reason reason = stop_reason::end_time;  ///< why it ended
  std::string stopped_by = {};                 ///< the name of the event that ended it, if any
};

/// A ready-made function of a sweep: integrates a case to t_end and keeps the final state.
///
///   const auto start = [](const auto& c) { return kte::dormand_prince45(swing{c["length"]}, 0.0, x0(c)); };
///   kte::sweep s(cases, {"angle", "speed"}, kte::final_state(10.0, start));
///   kte::sweep s(cases, {"angle", "speed"}, kte::in_packs<P>(kte::final_state(10.0, start)));
///
/// t_end: a number, or a function of a `sweep_case<double>`. start(c) returns the solver of a case; with packs, an
/// explicit Runge-Kutta method on states of packs. If its right-hand side takes a pack of times, each lane has its own
/// time, steps, end and events; a lane that ends gets the next case. Otherwise the lanes of a pack have common steps.
template <class End, class Start, class Events = detail::no_events, class Keep = detail::keep_state>
class final_state_of {
 public:
  final_state_of(End t_end, Start start, Events events = {}, Keep keep = {})
      : t_end_(std::move(t_end)), start_(std::move(start)), events_(std::move(events)), keep_(std::move(keep)) {}

  /// With events: f(c) returns the events of a case, a `sweep_case<double>`, as `kte::events(...)`; or a std::pair of
  /// what the events refer to (such as a std::shared_ptr) and the events. A case ends at a terminal event.
  template <class F>
  [[nodiscard]] final_state_of<End, Start, F, Keep> with_events(F f) const {
    return {t_end_, start_, std::move(f), keep_};
  }
  /// Keeps f(end) instead of the state: an array or vector of numbers of a `simulation_end`.
  template <class F>
  [[nodiscard]] final_state_of<End, Start, Events, F> keep(F f) const {
    return {t_end_, start_, events_, std::move(f)};
  }

  /// One case, or a pack of cases with common steps.
  template <class S>
  auto operator()(const sweep_case<S>& c) const {
    static_assert(
        !has_events || std::is_same_v<S, double>,
        "kte: events in packs need an explicit Runge-Kutta method with a right-hand side that takes a pack of "
        "times, f(const P& t, const X& x)");
    auto solver = start_(c);
    using X = std::remove_cvref_t<decltype(solver.state())>;
    simulation_end<X> end;
    if constexpr (has_events) {
      auto events = events_(c);
      auto report = solver.integrate(end_time(c), detail::list_of_events(events));
      end.events = report.count, end.reason = report.reason, end.stopped_by = report.stopped_by_name;
    } else {
      solver.integrate(end_time(c));
    }
    end.time = solver.time(), end.state = solver.state();
    using kept = std::remove_cvref_t<decltype(keep_(end))>;
    return kept(keep_(end));
  }

  /// Whether there are events. This and what follows are the parts of a simulation, for lanes.
  static constexpr bool has_events = !std::is_same_v<Events, detail::no_events>;
  /// The solver of a case, or of a pack of cases.
  template <class S>
  auto start(const sweep_case<S>& c) const {
    return start_(c);
  }
  /// The end of a case, s.
  template <class S>
  double end_time([[maybe_unused]] const sweep_case<S>& c) const {
    if constexpr (std::is_arithmetic_v<End>) {
      return static_cast<double>(t_end_);
    } else {
      static_assert(std::is_same_v<S, double>,
                    "kte: in packs with common steps, all cases end at one time: a number; right-hand sides that take "
                    "a pack of times may have different ends");
      return static_cast<double>(t_end_(c));
    }
  }
  /// The events of a case.
  auto events(const sweep_case<double>& c) const { return events_(c); }
  /// The numbers to keep.
  template <class X>
  auto kept(const simulation_end<X>& end) const {
    using result = std::remove_cvref_t<decltype(keep_(end))>;
    return result(keep_(end));
  }
  /// Whether lanes have their own steps, with packs P.
  template <class P>
  static constexpr bool in_lanes = detail::steps_in_lanes<
      std::remove_cvref_t<decltype(std::declval<const Start&>()(std::declval<const sweep_case<P>&>()))>>;

 private:
  End t_end_;
  Start start_;
  [[no_unique_address]] Events events_;
  [[no_unique_address]] Keep keep_;
};

/// `final_state_of` a time and a function.
template <class End, class Start>
[[nodiscard]] auto final_state(End t_end, Start start) {
  return final_state_of<End, Start>(std::move(t_end), std::move(start));
}

}  // namespace kte
