#pragma once

#include <kte/events/detail/watched_events.hpp>

namespace kte::detail {

/// Finds the events in the last step of a solver, one after the other.
template <class Solver, class List>
class event_watch : public watched_events<Solver, List> {
  using base = watched_events<Solver, List>;

 public:
  using typename base::S;
  using typename base::status;

  event_watch(const Solver& solver, List& events, const S& t_end)
      : base(solver, events), t_end_(t_end), start_(solver.time()) {
    if constexpr (!base::count_is_fixed) values_.resize(this->count());
  }

  /// Searches the step from `begin` to the solver's time.
  void search(const S& begin) {
    begin_ = begin;
    end_ = this->solver_.time();
    this->for_each([&](auto& e, status& s, std::size_t k) { set_out(e, s, k); });
    search_shared();
    if (end_ == t_end_) this->for_each([&](auto& e, status& s, std::size_t k) { look_at_end(e, s, k); });
  }
  /// The next crossing of the step: the events k that `happens`, at the time `next()`. Events whose times cannot be
  /// distinguished happen together, when the last of them is beyond zero.
  bool find_next() {
    bool any = false;
    for (const status& s : this->status_)
      if (s.found && (!any || is_before(s.time, next_))) next_ = s.time, any = true;
    if (!any) return false;
    const S first = next_, together = 64 * resolution(first);
    for (status& s : this->status_) {
      s.happens = s.found && distance(s.time, first) <= together;
      if (s.happens && is_before(next_, s.time)) next_ = s.time;
    }
    seen_ = next_;
    for (const status& s : this->status_)
      if (s.happens && is_before(seen_, s.seen)) seen_ = s.seen;
    return true;
  }
  const S& next() const { return next_; }
  /// A time at which the events that happen next are beyond zero, if they happen at the start of the step; `next()`
  /// otherwise.
  const S& seen() const { return seen_; }
  /// Continues the search after a crossing that has not ended the step.
  template <class E>
  void pass(E& e, status& s, std::size_t k) {
    s.found = false;
    s.reached = -s.reached;
    s.noise = s.noise_there = s.next_noise;
    search_from(e, s, k, next_);
  }

  static S distance(const S& a, const S& b) {
    using std::abs;
    return abs(S(a - b));
  }
  /// The rounding error of times near t.
  S resolution(const S& t) const {
    using std::abs;
    const S size = abs(t), since = distance(t, start_);
    return std::numeric_limits<S>::epsilon() * (size < since ? since : size);
  }

 private:
  using finder = crossing_search<S>;

  bool is_before(const S& a, const S& b) const { return begin_ < end_ ? a < b : b < a; }
  template <class E>
  bool is_wanted(const E& e, const status& s) const {
    return finder(e.direction, s.reached, S(0), 0).is_wanted(begin_ < end_);
  }
  static void found(status& s, const S& t, const S& seen) {
    s.found = true;
    s.time = t;
    s.seen = seen;
    s.next_noise = (std::numeric_limits<S>::min)();  // not 0, because g was just zero
  }

  /// Searches an event at zero from where it has left zero, and the others together.
  template <class E>
  void set_out(E& e, status& s, std::size_t k) {
    s.reached = s.side;
    s.noise_there = s.noise;
    s.found = false;
    s.shared = s.side != 0 && (s.value != S(0) || s.noise != S(0));
    s.stuck = s.shared && s.from == -s.side;
    if (s.shared) return;
    const auto left = depart(this->along(e, k), begin_, end_, s.noise);
    s.stuck = left.side != 0 && s.from == -left.side;
    if (left.side == 0 || s.stuck) return;
    if (s.side == -left.side && is_wanted(e, s))
      return found(s, begin_, left.time);  // the previous step has ended at zero
    if (e.is_unilateral && s.side == 0 && left.side < 0 && begin_ < end_) {
      s.reached = 1;
      return found(s, left.time, left.time);
    }
    s.reached = left.side;
    search_from(e, s, k, left.time);
  }
  /// Computes the states along the step once for all events.
  void search_shared() {
    const int pieces = this->settings().pieces;
    for (int p = 0; p < pieces; ++p) {
      bool any = false;
      for (const status& s : this->status_) any = any || (s.shared && !s.found);
      if (!any) return;
      const S a = finder::time_of(begin_, end_, p, pieces), b = finder::time_of(begin_, end_, p + 1, pieces);
      this->for_each([&](auto&, status& s, std::size_t k) { values_[k][0] = p == 0 ? s.value : values_[k][8]; });
      for (int i = 1; i <= 8; ++i) {
        const S t = finder::time_of(a, b, i, 8);
        const auto& x = this->state(t);
        this->for_each([&](auto& e, status& s, std::size_t k) {
          if (s.shared && !s.found) values_[k][static_cast<std::size_t>(i)] = this->value(e, k, t, x);
        });
      }
      this->for_each([&](auto& e, status& s, std::size_t k) {
        if (s.shared && !s.found) search_piece(e, s, k, a, b);
      });
    }
  }
  template <class E>
  void search_from(E& e, status& s, std::size_t k, const S& from) {
    const auto g = this->along(e, k);
    const int pieces = from == end_ ? 0 : this->settings().pieces;
    for (int p = 0; p < pieces && !s.found; ++p) {
      const S a = finder::time_of(from, end_, p, pieces), b = finder::time_of(from, end_, p + 1, pieces);
      for (int i = 0; i <= 8; ++i) values_[k][static_cast<std::size_t>(i)] = g(finder::time_of(a, b, i, 8));
      search_piece(e, s, k, a, b);
    }
  }
  template <class E>
  void search_piece(E& e, status& s, std::size_t k, const S& a, const S& b) {
    finder in(e.direction, s.reached, s.noise_there, this->settings().depth);
    s.found = in.find(this->along(e, k), a, b, values_[k]);
    s.reached = in.side();
    s.time = in.time();
    s.seen = in.seen();
    s.noise_there = in.noise();
    s.next_noise = in.next_noise();
  }
  /// A zero at the end of a step is decided by the next step; at the end of the integration it is a crossing.
  template <class E>
  void look_at_end(E& e, status& s, std::size_t k) {
    if (s.found || s.reached == 0 || s.noise_there != S(0) || this->value(e, k, end_, this->solver_.state()) != S(0))
      return;
    if (is_wanted(e, s)) found(s, end_, end_);
  }

  S t_end_, start_, begin_{}, end_{}, next_{}, seen_{};
  typename base::template for_each_event<typename finder::values> values_;
};

}  // namespace kte::detail
