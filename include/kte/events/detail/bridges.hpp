#pragma once

#include <kte/events/detail/event_watch.hpp>

#include <optional>

namespace kte::detail {

/// Whether an event can carry a state over a time that steps do not pass: `patience()` is the time that many steps must
/// bring, s, or 0; `bridge(t, x, t_end, n)`, with n bridges before it, moves x and returns its time.
template <class Event, class S, class X>
constexpr bool can_bridge = requires(Event& e, const S& t, X& x) {
  e.function.patience();
  e.function.bridge(t, x, t, 0);
};

/// Decides when bridges are needed, and finds the event that builds them.
template <class Solver, class List>
class bridges {
 public:
  using watch = event_watch<Solver, List>;
  using S = typename watch::S;
  using X = typename watch::X;
  using status = typename watch::status;

  bridges(watch& all, const event_settings& settings, const S& start)
      : watch_(all), settings_(settings), milestone_(start) {}

  /// Call it once events know their tolerances.
  void start() {
    watch_.for_each([&](auto& e, status&, std::size_t) {
      if constexpr (can_bridge<decltype(e), S, X>) patience_ = (std::max)(patience_, S(e.function.patience()));
    });
  }
  bool are_possible() const { return patience_ > S(0) && settings_.bridge != bridging::never; }
  /// Whether many steps have brought less than `patience`; called once for each step, at its start.
  bool are_needed_at(const S& t) {
    if (!(patience_ > S(0))) return false;
    if (watch::distance(t, milestone_) > patience_) milestone_ = t, steps_since_ = 0;
    return ++steps_since_ > most_steps;
  }
  struct bridge {
    S until;            ///< s
    std::size_t event;  ///< the number of the event that built it
    std::string name;
  };
  /// Carries x over a time from t by the first event that can.
  std::optional<bridge> carry(const S& t, X& x, const S& t_end) {
    std::optional<bridge> found;
    if (!are_possible() || !(t < t_end)) return found;
    watch_.for_each([&](auto& e, status&, std::size_t k) {
      if constexpr (can_bridge<decltype(e), S, X>) {
        if (found || !(S(e.function.patience()) > S(0))) return;
        X after = x;
        if (const auto until = without_error([&] { return S(e.function.bridge(t, after, t_end, in_a_row_)); })) {
          found = bridge{*until, k, std::string(watch::name_of(e))};
          x = after;
        }
      }
    });
    if (!found) return found;
    in_a_row_ = watch::distance(t, milestone_) > S(100) * watch::distance(found->until, t) ? 1 : in_a_row_ + 1;
    milestone_ = found->until, steps_since_ = 0;
    return found;
  }

 private:
  /// Steps, each of a bridge's length or less, after which a bridge helps.
  static constexpr int most_steps = 3000;

  template <class Make>
  static std::optional<S> without_error(const Make& make) {
#if defined(__cpp_exceptions)
    try {
      return make();
    } catch (const error&) {
      return {};
    }
#else
    return make();
#endif
  }

  watch& watch_;
  const event_settings& settings_;
  S patience_{0}, milestone_;
  int steps_since_ = 0, in_a_row_ = 0;
};

}  // namespace kte::detail
