#pragma once

#include <kte/integrators/observers.hpp>

#include <type_traits>
#include <utility>

/// Receivers of the progress of an integration. Each call returns whether to continue:
///
///   start(solver)           once; after events at the start, if the optional starts_after_events() is true
///   step(solver)            the last step is valid to its end
///   before(solver, t, x)    the last step is valid to an event that ends it, with the state x
///   after(solver, t, x)     the state after a reset
///
///   pass(t, x)              optional, after `before` of an event without a reset: it is handled, the state is still x
///   finish(t, x)            optional, at the end of the integration by a terminal event
///   skip(t, x, t2, x2)      optional, between `before` and `after`: the motion from t to t2 is not known
///
///   settle(solver)          after a call has returned false: moves the solver to the requested time, unless that is
///                          the end of the step or the event; returns whether it did
namespace kte::detail {

struct no_observer {
  template <class... A>
  bool start(const A&...) {
    return true;
  }
  template <class... A>
  bool step(const A&...) {
    return true;
  }
  template <class... A>
  bool before(const A&...) {
    return true;
  }
  template <class... A>
  bool after(const A&...) {
    return true;
  }
  template <class Solver>
  bool settle(Solver&) {
    return false;
  }
};

/// Calls an observer. Returns its result if that is a bool, otherwise true.
template <class Observer, class S, class X>
bool tell(Observer& observer, const S& t, const X& x) {
  if constexpr (std::is_same_v<std::invoke_result_t<Observer&, const S&, const X&>, bool>) {
    return observer(t, x);
  } else {
    observer(t, x);
    return true;
  }
}

template <class Observer>
class step_observer {
 public:
  explicit step_observer(Observer& observer) : observer_(observer) {}

  template <class Solver>
  bool start(const Solver& solver) {
    return step(solver);
  }
  template <class Solver>
  bool step(const Solver& solver) {
    return tell(observer_, solver.time(), solver.state());
  }
  template <class Solver, class S, class X>
  bool before(const Solver&, const S& t, const X& x) {
    return tell(observer_, t, x);
  }
  template <class Solver, class S, class X>
  bool after(const Solver&, const S& t, const X& x) {
    return tell(observer_, t, x);
  }
  template <class Solver>
  bool settle(Solver&) {
    return false;
  }

 private:
  Observer& observer_;
};

/// Calls an observer at the times of samples, and with event rows also before and after resets. A sample at the time of
/// an event has the state after it.
template <class Samples, class S, class X, class Observer>
class sample_observer {
 public:
  sample_observer(const Samples& samples, const S& t_start, const S& t_end, const X& x, bool event_rows,
                  Observer& observer)
      : samples_(samples), forward_(t_start < t_end), event_rows_(event_rows), x_(x), observer_(observer) {}

  bool starts_after_events() const { return !event_rows_; }
  template <class Solver>
  bool start(const Solver& solver) {
    return step(solver);
  }
  template <class Solver>
  bool step(const Solver& solver) {
    return sample_before(solver, solver.time()) && sample_at(solver.time(), solver.state());
  }
  template <class Solver>
  bool before(const Solver& solver, const S& t, const X& x) {
    return sample_before(solver, t) && (!event_rows_ || tell(observer_, t, x));
  }
  bool pass(const S& t, const X& x) { return sample_at(t, x, event_rows_); }
  template <class Solver>
  bool after(const Solver&, const S& t, const X& x) {
    return event_rows_ && !is_next(t) ? tell(observer_, t, x) : sample_at(t, x);
  }
  /// Even samples have the end of the integration.
  bool finish(const S& t, const X& x) {
    const bool is_told = event_rows_ || (next_ > 0 && samples_[next_ - 1] == t);
    return !Samples::has_end || is_told || tell(observer_, t, x);
  }
  /// Samples get the nearest state.
  bool skip(const S& t, const X& x, const S& t2, const X& x2) {
    if (!pass(t, x)) return false;
    while (next_ < samples_.count()) {
      const S sample = samples_[next_];
      if (forward_ ? sample >= t2 : sample <= t2) break;
      ++next_;
      if (!tell(observer_, sample, sample - t < t2 - sample ? x : x2)) return false;
    }
    return true;
  }
  template <class Solver>
  bool settle(Solver& solver) {
    if (stopped_within_) solver.restart(samples_[next_ - 1], x_);
    return stopped_within_;
  }

 private:
  bool is_next(const S& t) const { return next_ < samples_.count() && samples_[next_] == t; }
  /// The samples at t; the first of them may be `told` already.
  bool sample_at(const S& t, const X& x, bool told = false) {
    for (; is_next(t); told = false) {
      ++next_;
      if (!told && !tell(observer_, t, x)) return false;
    }
    return true;
  }
  template <class Solver>
  bool sample_before(const Solver& solver, const S& t) {
    for (; next_ < samples_.count();) {
      const S sample = samples_[next_];
      if (forward_ ? sample >= t : sample <= t) break;
      solver.interpolate(sample, x_);
      ++next_;
      if (!tell(observer_, sample, x_)) return stopped_within_ = true, false;
    }
    return true;
  }

  Samples samples_;
  bool forward_, event_rows_, stopped_within_ = false;
  long long next_ = 0;
  X x_;
  Observer& observer_;
};

/// An observer that is a receiver itself, such as `solution`.
template <class Observer>
concept follower = requires {
  typename Observer::follows_steps;
};

template <class Solver, class S>
no_observer follower_of(const Solver&, const S&) {
  return {};
}
template <class Solver, class S, class Observer>
decltype(auto) follower_of(const Solver&, const S&, Observer& observer) {
  if constexpr (follower<Observer>) {
    return (observer);
  } else {
    return step_observer<Observer>(observer);
  }
}
template <class Solver, class S, class Times, class Observer>
auto follower_of(const Solver& solver, const S& t_end, const Times& times, Observer& observer) {
  check_finite(t_end, "end time");
  using X = std::remove_cvref_t<decltype(solver.state())>;
  using samples = decltype(sample_times(t_end, t_end, times));
  return sample_observer<samples, S, X, Observer>(sample_times(solver.time(), t_end, times), solver.time(), t_end,
                                                  solver.state(), times.event_rows, observer);
}

}  // namespace kte::detail
