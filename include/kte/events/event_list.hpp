#pragma once

#include <kte/events/event.hpp>

#include <cstddef>
#include <tuple>
#include <vector>

namespace kte {

/// How events are looked for.
struct event_settings {
  int pieces = 1;            ///< of each step that are searched one by one: more for a g that waves within a step
  int depth = 20;            ///< how often a piece is halved where g may change its sign twice
  double shortest = 0;       ///< s: a reset again within this time is one too many. Never less than 1e4 eps |t|
  long long most = 1000000;  ///< events of one integration: one more is `stop_reason::zeno`
};

/// Something that happened. X: the state.
template <class X>
struct event_occurrence {
  std::size_t event;        ///< in the order of `events(...)`, from 0
  typename X::Scalar time;  ///< the first at which g is found beyond zero
  X before, after;          ///< the same unless the event has a reset
  bool rest = false;        ///< `rest` was called, not `reset`
};

enum class stop_reason {
  end_time,
  terminal,  ///< at a terminal event
  zeno       ///< resets came ever closer, or one could not be separated from the next, or too many events
};

/// What `integrate` with events gives back.
template <class X>
struct event_report {
  std::vector<event_occurrence<X>> events;  ///< in the order of time; empty with `report_to`
  long long count = 0;
  stop_reason reason = stop_reason::end_time;
  std::size_t stopped_by = 0;  ///< which event, unless the reason is the end time
};

/// What `events` makes.
template <class Sink, class... E>
struct event_list {
  std::tuple<E...> list;
  event_settings settings;
  Sink sink;

  event_list with(const event_settings& s) const { return {list, s, sink}; }
  /// Calls f(const event_occurrence<X>&) at each event instead of keeping a list: for long runs.
  template <class F>
  event_list<F, E...> report_to(F f) const {
    return {list, settings, std::move(f)};
  }
};

/// Events to watch; what comes at the same time is handled in this order.
template <class... G, class... Reset, class... Rest>
event_list<detail::no_handler, event<G, Reset, Rest>...> events(event<G, Reset, Rest>... e) {
  static_assert(((!event<G, Reset, Rest>::has_rest || event<G, Reset, Rest>::has_reset) && ...),
                "kte: `rest` ends a row of resets: give the event a `reset` too");
  return {{std::move(e)...}, {}, {}};
}

/// The events of both lists, those of the first before those of the second; settings and `report_to` of the first.
template <class Sink, class... A, class... B>
event_list<Sink, A..., B...> joined(const event_list<Sink, A...>& a, const event_list<detail::no_handler, B...>& b) {
  return {std::tuple_cat(a.list, b.list), a.settings, a.sink};
}

}  // namespace kte
