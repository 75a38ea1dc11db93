#pragma once

#include <kte/events/detail/event_status.hpp>
#include <kte/events/event_list.hpp>

#include <string>

namespace kte::detail {

/// The events of a list along the last step of a solver, each with its status.
template <class Solver, class List>
class watched_events {
 public:
  using S = typename Solver::S;
  using X = std::remove_cvref_t<decltype(std::declval<const Solver&>().state())>;
  using status = event_status<S>;

  watched_events(const Solver& solver, List& events) : solver_(solver), events_(events), x_(solver.state()) {
    const auto& s = events.settings;
    if (s.pieces < 1 || s.pieces > event_settings::most_pieces)
      raise<bad_argument>("kte: pieces of a step must be between 1 and " + std::to_string(event_settings::most_pieces) +
                          ", got " + std::to_string(s.pieces));
    if (s.depth < 0) raise<bad_argument>("kte: depth must not be negative, got " + std::to_string(s.depth));
    if constexpr (!count_is_fixed) status_.resize(count());
    for_each([&](auto& e, status& own, std::size_t k) { own.renew(value(e, k, solver.time(), x_)); });
  }

  /// Calls f(event, status, k) for all.
  template <class F>
  void for_each(const F& f) {
    std::size_t k = 0;
    std::apply([&](auto&... e) { (visit(e, k, f), ...); }, events_.list);
  }
  /// The g of an event at a time and state.
  template <class E>
  S value(E& e, std::size_t k, const S& t, const X& x) const {
    const S y = e.function(t, x);
    if (!is_finite(y)) [[unlikely]]
      refuse(e, k, t, "function", " is not a finite number there", failure_reason::event_function);
    return y;
  }
  /// "the function of event 2 'wall' is not a finite number there"
  template <class E>
  [[noreturn, gnu::cold, gnu::noinline]] static void refuse(const E& e, std::size_t k, const S& t, const char* part,
                                                            const char* why, failure_reason reason,
                                                            long long component = -1) {
    const auto when = static_cast<double>(t);
    raise<integration_failure>("kte: integration stopped before t = " + number(when) + ": the " + part + " of event " +
                                   std::to_string(k) + quoted(name_of(e)) + why,
                               when, reason, std::string(name_of(e)), component);
  }
  /// The name given by `named`, otherwise that of its function.
  template <class E>
  static auto name_of(const E& e) {
    if constexpr (requires { e.function.name(); }) {
      return e.name.empty() ? e.function.name() : std::string(e.name);
    } else {
      return e.name;
    }
  }
  /// What the last reset of an event has changed, if its function tells it.
  template <class E>
  static std::string_view change_of(const E& e) {
    if constexpr (requires { e.function.what(); })
      return e.function.what();
    else
      return {};
  }

 protected:
  static constexpr bool count_is_fixed = []<class... E>(std::type_identity<std::tuple<E...>>) {
    return (kind_of_event<E>::is_single && ...);
  }(std::type_identity<decltype(List::list)>{});
  template <class T>
  using for_each_event =
      std::conditional_t<count_is_fixed, std::array<T, std::tuple_size_v<decltype(List::list)>>, std::vector<T>>;

  std::size_t count() {
    std::size_t n = 0;
    const auto one = [](auto& e) -> std::size_t {
      if constexpr (requires { e.size(); }) return e.size();
      return 1;
    };
    std::apply([&](auto&... e) { n = (std::size_t{0} + ... + one(e)); }, events_.list);
    return n;
  }

  /// The state at a time of the last step.
  const X& state(const S& t) {
    solver_.interpolate(t, x_);
    return x_;
  }
  /// The g of an event as a function of the time in the last step.
  template <class E>
  auto along(E& e, std::size_t k) {
    return [this, &e, k](const S& t) { return value(e, k, t, state(t)); };
  }

  const Solver& solver_;
  const event_settings& settings() const { return events_.settings; }
  for_each_event<status> status_;

 private:
  template <class E, class F>
  void visit(E& e, std::size_t& k, const F& f) {
    f(e, status_[k], k);
    ++k;
  }
  template <class E, class F>
  void visit(std::vector<E>& some, std::size_t& k, const F& f) {
    for (E& e : some) visit(e, k, f);
  }
  static std::string quoted(std::string_view name) { return name.empty() ? "" : " '" + std::string(name) + "'"; }

  List& events_;
  X x_;
};

}  // namespace kte::detail
