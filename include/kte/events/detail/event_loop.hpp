#pragma once

#include <kte/events/detail/bridges.hpp>
#include <kte/events/detail/event_record.hpp>
#include <kte/events/detail/way_back.hpp>
#include <kte/integrators/integrator.hpp>

namespace kte::detail {

/// Integrates with events: takes a step, searches its dense output for crossings, handles them in order of time. An
/// event that acts ends the step there and restarts the solver. If an event function throws, or the observer before an
/// event, the solver stays before the event and finds it again.
template <class Solver, class List, class Observer>
class event_loop {
  using watch = event_watch<Solver, List>;
  using S = typename watch::S;
  using X = typename watch::X;
  using status = typename watch::status;

 public:
  event_loop(Solver& solver, const S& t_end, List& events, Observer observer)
      : solver_(solver),
        events_(events),
        observer_(static_cast<Observer&&>(observer)),
        watch_(solver, events, t_end),
        bridges_(watch_, events.settings, solver.time()),
        record_(events, solver.state()),
        t_end_(t_end),
        goal_(t_end),
        last_action_(solver.time()),
        safe_time_(solver.time()),
        x_(solver.state()),
        safe_(x_) {}

  event_report<X> run() {
    start();
    while (goes_on()) {
      note_begin();
      if (!bridges_.are_needed_at(begin_) || !bridge("steps pile up")) step_or_bridge();
    }
    record_.report().time = solver_.time();
    return std::move(record_.report());
  }
  // ---- the parts of `run`, for lanes of packs: `begin_step`, a step of the solver towards its goal, `after_step`
  void start() {
    const bool late = starts_after_events();
    if (!late) obey(observer_.start(solver_));
    watch_.for_each([&](auto& e, status&, std::size_t) {
      if constexpr (requires { e.function.tolerate(solver_.bounds()); }) e.function.tolerate(solver_.bounds());
    });
    bridges_.start();
    if (!goes_on() || !mend_start()) solver_.begin(goal_);
    if (late) obey(observer_.start(solver_));
  }
  bool goes_on() const { return !record_.stopped() && solver_.time() != t_end_; }
  void begin_step() {
    note_begin();
    renew_goal();
  }
  void after_step() {
    return_path back(solver_, safe_time_, safe_);
    end_step_or_act(back);
  }
  const event_report<X>& report() { return record_.report(); }

 private:
  void note_begin() {
    begin_ = solver_.time();
    keep(begin_, solver_.state());
  }
  void renew_goal() {
    if (solver_.time() == goal_) go_for(t_end_);
  }
  bool starts_after_events() const {
    if constexpr (requires { observer_.starts_after_events(); })
      return observer_.starts_after_events();
    else
      return false;
  }
  /// A step; where it fails, modes are decided again, once at a time, as where the rank of contacts has changed in the
  /// step before; otherwise a bridge.
  void step_or_bridge() {
    const auto step = [this] {
      renew_goal();
      return_path back(solver_, safe_time_, safe_);
      solver_.step(goal_);
      end_step_or_act(back);
    };
#if defined(__cpp_exceptions)
    if (bridges_.are_possible()) {
      try {
        return step();
      } catch (const error& why) {
        if (is_in_handler_ || !(mend_again() || bridge(why.what()))) throw;
        return;
      }
    }
#endif
    step();
  }
  /// Carries the state over a time that steps do not pass. Returns whether an event could.
  bool bridge(const std::string& why) {
    const S t = solver_.time();
    const X before = solver_.state();
    X after = before;
    const auto over = bridges_.carry(t, after, t_end_);
    if (!over) return false;
    const S& until = over->until;
    x_ = after;
    record_.before(over->event, over->name, t, before);
    obey(observer_.before(solver_, t, before));
    if constexpr (requires { observer_.skip(t, before, until, x_); }) obey(observer_.skip(t, before, until, x_));
    record_.after_bridge(
        until, x_,
        "bridged " + number(static_cast<double>(t)) + " s to " + number(static_cast<double>(until)) + " s: " + why);
    keep(until, x_);
    restart(until);
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      s = {};
      s.renew(watch_.value(e, k, until, x_));
    });
    obey(observer_.after(solver_, until, x_));
    last_action_ = until;
    if (goes_on()) go_for(t_end_);
    return true;
  }
  using return_path = way_back<Solver, S, X>;

  /// Events at the start: modes of elements that are inconsistent because inputs or the state have been changed. A g
  /// that is merely beyond zero is not an event.
  /// Returns whether there were such.
  bool mend_start() {
    const S t = solver_.time();
    bool any = false;
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      if constexpr (requires { e.function.mend(t, x_); }) {
        if (s.value > S(0)) return;
        safe_ = x_;
        if (!e.function.mend(t, x_)) return;
        any = true;
        record_.before(k, watch::name_of(e), t, safe_);
        record_.after(x_, false, watch::change_of(e));
      }
    });
    if (!any) return false;
    solver_.restart(t, x_);
    watch_.for_each([&](auto& e, status& s, std::size_t k) { s.renew(watch_.value(e, k, t, x_)); });
    obey(observer_.after(solver_, t, x_));
    go_for(goal_);
    return true;
  }
#if defined(__cpp_exceptions)
  bool mend_again() {
    const S t = solver_.time();
    if (has_mended_ && t == last_mend_) return false;
    has_mended_ = true, last_mend_ = t;
    x_ = solver_.state();
    try {
      watch_.for_each([&](auto& e, status& s, std::size_t k) { s.value = watch_.value(e, k, t, x_); });
      return mend_start();
    } catch (const error&) {
      return false;
    }
  }
#endif
  void end_step_or_act(return_path& back) {
    watch_.search(begin_);
    if (!one_is_stuck(back) && !handle_crossings(back)) end_step(back);
    back.arrived();
  }
  /// Finishes everything until t.
  void keep(const S& t, const X& x) {
    safe_time_ = t;
    safe_ = x;
  }
  /// Restarts at the state x_, with a step of similar length.
  void restart(const S& t) {
    if constexpr (requires { solver_.restart(t, x_, keep_step); }) {
      solver_.restart(t, x_, keep_step);
    } else {
      solver_.restart(t, x_);
    }
  }
  void go_for(const S& t) {
    goal_ = t;
    solver_.begin(t);
  }
  void end_step(return_path& back) {
    watch_.for_each(
        [&](auto& e, status& s, std::size_t k) { s.renew(watch_.value(e, k, solver_.time(), solver_.state())); });
    back.arrived();
    if (observer_.step(solver_)) return;
    obey(kte::stop);
    observer_.settle(solver_);
  }
  /// Obeys the result of an observer.
  void obey(bool goes_on) {
    if (!goes_on) record_.stop(stop_reason::observer, 0, {});
  }

  /// Returns whether the step has ended early.
  bool handle_crossings(return_path& back) {
    for (bool first = true; watch_.find_next(); first = false) {
      bool acts = false;
      watch_.for_each([&](auto& e, status& s, std::size_t) { acts = acts || (s.happens && e.acts()); });
      if (acts && first && is_early()) return take_shorter_step();
      solver_.interpolate(watch_.next(), x_);
      if (acts) return act(back);
      watch_.for_each([&](auto& e, status& s, std::size_t k) {
        if (!s.happens) return;
        record_.before(k, watch::name_of(e), watch_.next(), x_);
        record_.after(x_, false);
        watch_.pass(e, s, k);
      });
      if (record_.stopped()) {
        restart(watch_.next());
        return true;
      }
      keep(watch_.next(), x_);
    }
    return false;
  }

  /// An event early in a long step is located again in a short one, with the rounding of the short step, and without
  /// the error of interpolation of the long one: E theta^2 at theta of a step of error E, which a g that leaves zero as
  /// the cube of time, as the gap of a contact that lifts, exceeds only later.
  bool is_early() const {
    return watch_.seen() != begin_ &&
           16 * watch::distance(watch_.seen(), begin_) < watch::distance(solver_.time(), begin_);
  }
  bool take_shorter_step() {
    solver_.interpolate(begin_, x_);
    restart(begin_);
    go_for(S(begin_ + 2 * (watch_.seen() - begin_)));
    return true;
  }

  /// Ends the step at the events that happen next, with the state x_.
  bool act(return_path& back) {
    const S t = watch_.next();
    const bool goes_on = observer_.before(solver_, t, x_);
    if (!goes_on && observer_.settle(solver_)) return back.arrived(), obey(goes_on), true;
    bool reset = false;
    const void* handled = nullptr;
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      if (!s.happens) return;
      if (e.handled_by && e.handled_by == handled) return void(s.rested = false);
      handled = e.handled_by;
      record_.before(k, watch::name_of(e), t, x_);
      if constexpr (std::remove_cvref_t<decltype(e)>::has_reset) {
        reset = true;
        call_reset(e, s, k, t);
      }
      record_.after(x_, s.rested, watch::change_of(e));
      if (e.is_terminal) record_.stop(stop_reason::terminal, k, watch::name_of(e));
    });
    restart(t);
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      if (record_.stopped()) return;
      const S y = watch_.value(e, k, t, x_);
      s.allow_rounding(S(e.rounding), y);
      s.happens ? s.rested ? s.renew_at_rest(y) : s.renew_at_crossing(y) : s.renew_elsewhere(y);
    });
    back.arrived();
    obey(goes_on);
    if (reset)
      obey(observer_.after(solver_, t, x_));
    else if constexpr (requires { observer_.pass(t, x_); })
      obey(observer_.pass(t, x_));
    if constexpr (requires { observer_.finish(t, x_); })
      if (record_.report().reason == stop_reason::terminal) obey(observer_.finish(t, x_));
    if (!record_.stopped()) go_on_after(t);
    if (!record_.stopped() && (is_zeno_ || events_.settings.bridge == bridging::at_every_event))
      (void)bridge(is_zeno_ ? "events do not end" : "an event");
    return true;
  }
  template <class E>
  void call_reset(E& e, status& s, std::size_t k, const S& t) {
    const S least = S(events_.settings.shortest), resolved = S(1e4) * watch_.resolution(t);
    const bool again = s.has_reset && watch::distance(t, s.last_reset) < (least < resolved ? resolved : least);
    s.repeats = again ? s.repeats + 1 : 0;
    const bool may_repeat = s.repeats <= e.most_repeats;
    is_zeno_ = false;
    if (again && !may_repeat && (s.rested || !E::has_rest)) {
      if (can_bridge<E, S, X> && bridges_.are_possible())
        is_zeno_ = true;
      else
        record_.stop(stop_reason::zeno, k, watch::name_of(e));
    }
    s.rested = again && E::has_rest && !record_.stopped();
    s.has_reset = true;
    s.last_reset = t;
    s.from = e.is_one_sided && !s.rested ? s.reached : 0;
    is_in_handler_ = !can_bridge<E, S, X>;
    if constexpr (E::has_rest)
      s.rested ? e.on_rest(t, x_) : e.on_reset(t, x_);
    else
      e.on_reset(t, x_);
    check_state(e, k, t, s.rested ? "rest" : "reset");
    is_in_handler_ = false;
  }
  /// Checks the state after an event.
  template <class E>
  void check_state(const E& e, std::size_t k, const S& t, const char* maker) const {
    for (Eigen::Index i = 0; i < x_.size(); ++i)
      if (!is_finite(S(x_[i]))) [[unlikely]]
        watch::refuse(e, k, t, maker, " makes the state not finite", failure_reason::not_finite, i);
  }
  /// Limits the next step to a small multiple of the time between the last two actions, so that accelerating sequences
  /// are resolved.
  void go_on_after(const S& t) {
    const S since = watch::distance(t, last_action_);
    if (since > S(0)) pace_ = since;
    last_action_ = t;
    const bool is_near = pace_ == S(0) || watch::distance(t_end_, t) <= 8 * pace_;
    go_for(is_near ? t_end_ : t < t_end_ ? S(t + 4 * pace_) : S(t - 4 * pace_));
  }

  /// If a reset did not send g back, the state counts as at rest, from the start of the step on.
  bool one_is_stuck(return_path& back) {
    bool any = false;
    watch_.for_each([&](auto&, status& s, std::size_t) { any = any || s.stuck; });
    if (!any) return false;
    solver_.interpolate(begin_, x_);
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      if (s.stuck) come_to_rest(e, s, k);
    });
    restart(begin_);
    if (record_.stopped()) return true;
    watch_.for_each([&](auto& e, status& s, std::size_t k) {
      const S y = watch_.value(e, k, begin_, x_);
      s.reached = s.side;
      s.stuck ? s.renew_at_rest(y) : s.renew_elsewhere(y);
    });
    back.arrived();
    obey(observer_.after(solver_, begin_, x_));
    go_for(goal_);
    return true;
  }
  template <class E>
  void come_to_rest(E& e, status& s, std::size_t k) {
    if constexpr (E::has_rest) {
      record_.before(k, watch::name_of(e), begin_, x_);
      e.on_rest(begin_, x_);
      check_state(e, k, begin_, "rest");
      s.rested = true;
      s.from = 0;
      s.last_reset = begin_;
      record_.after(x_, true);
      s.next_noise = s.noise;
    } else {
      record_.stop(stop_reason::zeno, k, watch::name_of(e));
    }
  }

  Solver& solver_;
  List& events_;
  Observer observer_;
  watch watch_;
  bridges<Solver, List> bridges_;
  event_record<X, List> record_;
  S t_end_, goal_, begin_{}, last_action_, pace_{0}, safe_time_, last_mend_{};
  bool is_zeno_ = false;        ///< whether resets of contacts at one time do not end
  bool has_mended_ = false;     ///< whether modes were decided again, at `last_mend_`
  bool is_in_handler_ = false;  ///< whether a handler runs whose errors bridges do not help
  X x_, safe_;
};

}  // namespace kte::detail
