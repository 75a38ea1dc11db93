#pragma once

#include <kte/events/event.hpp>
#include <kte/integrators/observers.hpp>

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace kte {

/// How events are looked for.
struct event_settings {
  static constexpr int most_pieces = 1000000;
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
  std::string name = {};    ///< as `named` gave it; of events of elements, the element's
};

/// What `integrate` with events gives back.
template <class X>
struct event_report {
  std::vector<event_occurrence<X>> events;  ///< in the order of time; empty with `report_to`
  long long count = 0;
  stop_reason reason = stop_reason::end_time;
  std::size_t stopped_by = 0;  ///< which event, unless the reason is the end time
  std::string stopped_by_name = {};

  /// The first of this name that happened, or null; among those kept.
  const event_occurrence<X>* find(std::string_view name) const {
    for (const auto& e : events)
      if (e.name == name) return &e;
    return nullptr;
  }
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

namespace detail {
/// An event, or as many of one type as there are at run time.
template <class E>
struct kind_of_event;
template <class G, class Reset, class Rest>
struct kind_of_event<event<G, Reset, Rest>> {
  static constexpr bool can_rest = !event<G, Reset, Rest>::has_rest || event<G, Reset, Rest>::has_reset;
  static constexpr bool is_one = true;
};
template <class E>
struct kind_of_event<std::vector<E>> {
  static constexpr bool can_rest = kind_of_event<E>::can_rest;
  static constexpr bool is_one = false;
};
}  // namespace detail

/// Events to watch, each an `event` or a vector of such; what comes at the same time is handled in this order, and
/// numbered so.
template <class... E>
requires(requires { detail::kind_of_event<E>::is_one; } && ...) event_list<detail::no_handler, E...> events(E... e) {
  static_assert((detail::kind_of_event<E>::can_rest && ...),
                "kte: `rest` ends a row of resets: give the event a `reset` too");
  return {{std::move(e)...}, {}, {}};
}

/// The events of both lists, those of the first before those of the second; settings and `report_to` of the first.
template <class Sink, class... A, class... B>
event_list<Sink, A..., B...> joined(const event_list<Sink, A...>& a, const event_list<detail::no_handler, B...>& b) {
  return {std::tuple_cat(a.list, b.list), a.settings, a.sink};
}

}  // namespace kte
