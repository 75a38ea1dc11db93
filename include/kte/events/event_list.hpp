#pragma once

#include <kte/detail/raise.hpp>
#include <kte/errors.hpp>
#include <kte/events/event.hpp>
#include <kte/integrators/observers.hpp>

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace kte {

/// Where integrations are carried over a time by other means than steps, if events have such: `bridge` of
/// models/detail/contact_bridge.hpp.
enum class bridging {
  never,          ///< the integration fails there
  when_needed,    ///< where no modes of contacts are found, or steps pile up
  at_every_event  ///< for tests
};

/// Settings of the search for events. `most_pieces` is the largest number of `pieces`.
struct event_settings {
  static constexpr int most_pieces = 1000000;
  int pieces = 1;       ///< parts of each step that are searched separately: more for a g that oscillates within a step
  int depth = 20;       ///< largest number of bisections of a part where g may change its sign twice
  double shortest = 0;  ///< s: resets closer than this accumulate. Never less than 1e4 eps |t|
  long long most = 1000000;  ///< events of one integration; one more ends it with `stop_reason::zeno`
  bridging bridge = bridging::when_needed;
};

/// An event that occurred. X: the state.
template <class X>
struct event_occurrence {
  std::size_t event;                ///< its number in the order of `events(...)`, from 0
  typename X::Scalar time;          ///< s, the first time found with g beyond zero
  X before, after;                  ///< states before and after the reset; equal without a reset
  bool rest = false;                ///< `rest` was called, not `reset`
  std::string name = {};            ///< the name of the event; for events of elements, of the element
  std::string what = {};            ///< what has changed, for events of contacts: "'foot': impact, sticks"
  typename X::Scalar until = time;  ///< s, of the state after; later than `time` only for bridges
};

namespace detail {
/// Throws `integration_failure` if events accumulate.
inline void require_no_zeno(stop_reason reason, double t, const std::string& name) {
  if (reason != stop_reason::zeno) return;
  const std::string of = name.empty() ? "" : " of '" + name + "'";
  raise<integration_failure>("kte: integration stopped at t = " + number(t) + ": events" + of +
                                 " do not end: they follow each other closer than time can resolve, or are too many",
                             t, failure_reason::accumulated_events, name);
}
}  // namespace detail

/// The result of `integrate` with events. `count`: the number of events; `reason`: why the integration ended;
/// `stopped_by_name`: the name of the event that ended it.
template <class X>
struct event_report {
  std::vector<event_occurrence<X>> events;  ///< in the order of time; empty with `report_to`
  long long count = 0;
  stop_reason reason = stop_reason::end_time;
  std::size_t stopped_by = 0;  ///< the event that ended the integration, unless the reason is the end time
  std::string stopped_by_name = {};
  typename X::Scalar time{};  ///< s, of the end

  /// Throws `integration_failure`, with the time and the name of the event, if events accumulate.
  void require_end() const { detail::require_no_zeno(reason, static_cast<double>(time), stopped_by_name); }

  /// The first kept occurrence of an event with this name, or null.
  [[nodiscard]] const event_occurrence<X>* find(std::string_view name) const {
    for (const auto& e : events)
      if (e.name == name) return &e;
    return nullptr;
  }
};

/// The list of events that `events` returns: `list`, `settings`, and a `sink` of occurrences.
template <class Sink, class... E>
struct event_list {
  std::tuple<E...> list;
  event_settings settings;
  Sink sink;

  /// The list with these settings.
  [[nodiscard]] event_list with(const event_settings& s) const { return {list, s, sink}; }
  /// Calls f(const event_occurrence<X>&) at each event instead of keeping a list, for long integrations.
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
  static constexpr bool is_single = true;
};
template <class E>
struct kind_of_event<std::vector<E>> {
  static constexpr bool can_rest = kind_of_event<E>::can_rest;
  static constexpr bool is_single = false;
};
}  // namespace detail

/// A list of events, each an `event` or a vector of events. They are numbered in this order; events at one time are
/// handled in this order.
template <class... E>
requires(requires { detail::kind_of_event<E>::is_single; } && ...) event_list<detail::no_handler, E...> events(E... e) {
  static_assert((detail::kind_of_event<E>::can_rest && ...),
                "kte: `rest` follows resets: give the event a `reset` too");
  return {{std::move(e)...}, {}, {}};
}

/// The events of both lists, those of the first before those of the second; settings and `report_to` of the first.
template <class Sink, class... A, class... B>
[[nodiscard]] event_list<Sink, A..., B...> joined(const event_list<Sink, A...>& a,
                                                  const event_list<detail::no_handler, B...>& b) {
  return {std::tuple_cat(a.list, b.list), a.settings, a.sink};
}

}  // namespace kte
