#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

namespace kte {

/// Which way g goes through zero, as time increases: also where it is integrated backward, so that both ways find the
/// same events.
enum class crossing { rising, falling, both };

namespace detail {
struct no_handler {};
struct change_nothing {
  template <class S, class X>
  void operator()(const S&, X&) const {}
};
}  // namespace detail

/// An event: g(t, x) goes through zero.
///
///   auto ground = kte::event([](double, const auto& x) { return x[0]; }, kte::crossing::falling)
///                     .reset([](double, auto& x) { x[1] *= -0.9; });
///
/// g is continuous along a solution, in any unit. The functions below give a new event and can be chained.
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

  /// Whether the step ends at it.
  constexpr bool acts() const { return has_reset || is_terminal; }

  /// A name, for reports and errors: a text that lives as long as the event, such as a literal.
  constexpr event named(std::string_view text) const {
    event e = *this;
    e.name = text;
    return e;
  }
  /// Integration ends at the event: there `time()` and `state()` of the solver are those of the event.
  constexpr event terminal() const {
    event e = *this;
    e.is_terminal = true;
    return e;
  }
  /// Calls handler(t, x) at the event, which may change the state x and whatever else the right-hand side depends on;
  /// then integration starts anew.
  template <class H>
  constexpr event<G, H, Rest> reset(H handler) const {
    return {function, direction, is_terminal, is_one_sided, std::move(handler), on_rest, name};
  }
  /// Ends the step at the event and starts anew from the same state: for a right-hand side with a kink there.
  constexpr event<G, detail::change_nothing, Rest> restart() const { return reset(detail::change_nothing{}); }

  /// The reset has to send g back to the side that it came from, as an impact does. Where it does not, within what
  /// time can resolve, that is a `stop_reason::zeno` instead of a fall through the floor.
  constexpr event one_sided() const {
    event e = *this;
    e.is_one_sided = true;
    return e;
  }
  /// The same, but calls handler(t, x) instead of stopping: it takes the place of infinitely many resets, for instance
  /// lets a ball lie on the floor.
  template <class H>
  constexpr event<G, Reset, H> rest(H handler) const {
    return {function, direction, is_terminal, true, on_reset, std::move(handler), name};
  }
};

template <class G>
event(G, crossing) -> event<G>;
template <class G>
event(G) -> event<G>;

}  // namespace kte
