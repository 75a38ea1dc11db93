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

/// An event: a zero of a function g(t, x) along the solution.
///
///   auto ground = kte::event([](double, const auto& x) { return x[0]; }, kte::crossing::falling)
///                     .reset([](double, auto& x) { x[1] *= -0.9; });
///
/// g must be continuous along a solution; its unit is arbitrary. The functions below return a changed event and can be
/// chained. They set the members `function` (g), `direction`, `is_terminal`, `is_one_sided`, `on_reset`, `on_rest` and
/// `name`; `has_reset` and `has_rest` tell whether there are such handlers.
template <class G, class Reset = detail::no_handler, class Rest = detail::no_handler>
struct event {
  G function;
  crossing direction;
  bool is_terminal = false;
  bool is_one_sided = false;
  [[no_unique_address]] Reset on_reset = {};
  [[no_unique_address]] Rest on_rest = {};
  std::string_view name = {};

  static constexpr bool has_reset = !std::is_same_v<Reset, detail::no_handler>;
  static constexpr bool has_rest = !std::is_same_v<Rest, detail::no_handler>;

  constexpr explicit event(G g, crossing way = crossing::both) : function(std::move(g)), direction(way) {}
  constexpr event(G g, crossing way, bool terminal, bool one_sided, Reset reset, Rest rest, std::string_view called)
      : function(std::move(g)),
        direction(way),
        is_terminal(terminal),
        is_one_sided(one_sided),
        on_reset(std::move(reset)),
        on_rest(std::move(rest)),
        name(called) {}

  /// Whether the step ends at the event.
  [[nodiscard]] constexpr bool acts() const { return has_reset || is_terminal; }

  /// Sets the name in reports and errors: a text that lives as long as the event, such as a literal.
  [[nodiscard]] constexpr event named(std::string_view text) const {
    event e = *this;
    e.name = text;
    return e;
  }
  /// Integration ends at the event: `time()` and `state()` of the solver are then those of the event.
  [[nodiscard]] constexpr event terminal() const {
    event e = *this;
    e.is_terminal = true;
    return e;
  }
  /// Calls handler(t, x) at the event. The handler may change the state x and data that the right-hand side depends on;
  /// then integration restarts.
  template <class H>
  [[nodiscard]] constexpr event<G, H, Rest> reset(H handler) const {
    return {function, direction, is_terminal, is_one_sided, std::move(handler), on_rest, name};
  }
  /// Ends the step at the event and restarts from the unchanged state, for a right-hand side with a kink there.
  [[nodiscard]] constexpr event<G, detail::change_nothing, Rest> restart() const {
    return reset(detail::change_nothing{});
  }

  /// The reset must return g to the side from which it came, as an impact does. Otherwise, within the resolution of
  /// time, the integration ends with `stop_reason::zeno`; without this the state would pass through the floor.
  [[nodiscard]] constexpr event one_sided() const {
    event e = *this;
    e.is_one_sided = true;
    return e;
  }
  /// Calls handler(t, x) where resets accumulate, instead of ending with `stop_reason::zeno`; for instance lets a ball
  /// rest on the floor.
  template <class H>
  [[nodiscard]] constexpr event<G, Reset, H> rest(H handler) const {
    return {function, direction, is_terminal, true, on_reset, std::move(handler), name};
  }
};

template <class G>
event(G, crossing) -> event<G>;
template <class G>
event(G) -> event<G>;

}  // namespace kte
