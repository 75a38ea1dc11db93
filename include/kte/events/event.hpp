#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

namespace kte {

/// The sign change of g at an event, as time increases: `rising`, `falling` or both. Integration backward uses the
/// sense of increasing time too, so that both directions find the same events.
enum class crossing { rising, falling, both };

namespace detail {
struct no_handler {};
struct change_nothing {
  template <class S, class X>
  void operator()(const S&, X&) const {}
};
}  // namespace detail

/// The properties of an event other than its functions. The functions of `event` with these names describe them.
struct event_options {
  crossing direction = crossing::both;  ///< the sign changes of g that are events
  bool is_terminal = false;             ///< `terminal`
  bool is_one_sided = false;            ///< `one_sided`
  bool is_unilateral = false;           ///< `unilateral`
  double rounding = 0;                  ///< `with_rounding`, in units of g
  const void* handled_by = nullptr;     ///< `reset_together`
  int most_repeats = 0;                 ///< `may_repeat`
  std::string_view name = {};           ///< `named`
};

/// An event: a zero of a function g(t, x) along the solution.
///
///   auto ground = kte::event([](double, const auto& x) { return x[0]; }, kte::crossing::falling)
///                     .reset([](double, auto& x) { x[1] *= -0.9; });
///
/// g must be continuous along a solution; its unit is arbitrary. The functions below return a changed event and can be
/// chained. They set the members `function` (g), `direction`, `on_reset`, `on_rest` and those of `event_options`;
/// `has_reset` and `has_rest` tell whether there are such handlers.
template <class G, class Reset = detail::no_handler, class Rest = detail::no_handler>
struct event : event_options {
  G function;
  [[no_unique_address]] Reset on_reset = {};
  [[no_unique_address]] Rest on_rest = {};

  static constexpr bool has_reset = !std::is_same_v<Reset, detail::no_handler>;
  static constexpr bool has_rest = !std::is_same_v<Rest, detail::no_handler>;

  constexpr explicit event(G g, crossing way = crossing::both) : event_options{way}, function(std::move(g)) {}
  constexpr event(G g, const event_options& options, Reset reset, Rest rest)
      : event_options(options), function(std::move(g)), on_reset(std::move(reset)), on_rest(std::move(rest)) {}

  /// Whether the step ends at the event.
  [[nodiscard]] constexpr bool acts() const { return has_reset || is_terminal; }

  /// Sets the name in reports and errors: a text that lives as long as the event, such as a literal.
  [[nodiscard]] constexpr event named(std::string_view text) const {
    return with([text](event_options& o) { o.name = text; });
  }
  /// Integration ends at the event: `time()` and `state()` of the solver are then those of the event.
  [[nodiscard]] constexpr event terminal() const {
    return with([](event_options& o) { o.is_terminal = true; });
  }
  /// Calls handler(t, x) at the event. The handler may change the state x and data that the right-hand side depends on;
  /// then integration restarts.
  template <class H>
  [[nodiscard]] constexpr event<G, H, Rest> reset(H handler) const {
    return {function, options(), std::move(handler), on_rest};
  }
  /// Ends the step at the event and restarts from the unchanged state, for a right-hand side with a kink there.
  [[nodiscard]] constexpr event<G, detail::change_nothing, Rest> restart() const {
    return reset(detail::change_nothing{});
  }

  /// The reset must return g to the side from which it came, as an impact does. Otherwise, within the resolution of
  /// time, the integration ends with `stop_reason::zeno`; without this the state would pass through the floor.
  [[nodiscard]] constexpr event one_sided() const {
    return with([](event_options& o) { o.is_one_sided = true; });
  }
  /// g >= 0 must hold: where g leaves zero downwards is an event too, without a sign of g before.
  [[nodiscard]] constexpr event unilateral() const {
    return with([](event_options& o) { o.is_unilateral = true; });
  }
  /// At an event, |g| up to this may be a rounding error of the state, also of other events at this time: for a g that
  /// is a difference of coordinates.
  [[nodiscard]] constexpr event with_rounding(double of_g) const {
    return with([of_g](event_options& o) { o.rounding = of_g; });
  }
  /// So many resets in a row may be closer than time can resolve, as of a contact that lands at an edge; without it,
  /// the second one ends the integration with `stop_reason::zeno`.
  [[nodiscard]] constexpr event may_repeat(int times) const {
    return with([times](event_options& o) { o.most_repeats = times; });
  }
  /// Events with the same `object` share a handler: of those that happen at one time, only the handler of the first is
  /// called.
  [[nodiscard]] constexpr event reset_together(const void* object) const {
    return with([object](event_options& o) { o.handled_by = object; });
  }
  /// Calls handler(t, x) where resets accumulate, instead of ending with `stop_reason::zeno`; for instance lets a ball
  /// rest on the floor.
  template <class H>
  [[nodiscard]] constexpr event<G, Reset, H> rest(H handler) const {
    return event<G, Reset, H>{function, options(), on_reset, std::move(handler)}.one_sided();
  }

  /// All properties other than the functions.
  [[nodiscard]] constexpr const event_options& options() const { return *this; }
  /// An event with these functions, the other properties being unchanged; for wrappers.
  template <class F, class H>
  [[nodiscard]] constexpr event<F, H, Rest> with_functions(F f, H handler) const {
    return {std::move(f), options(), std::move(handler), on_rest};
  }

 private:
  template <class Change>
  constexpr event with(const Change& change) const {
    event e = *this;
    change(static_cast<event_options&>(e));
    return e;
  }
};

template <class G>
event(G, crossing) -> event<G>;
template <class G>
event(G) -> event<G>;

}  // namespace kte
