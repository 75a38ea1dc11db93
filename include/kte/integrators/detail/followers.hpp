#pragma once

#include <kte/integrators/observers.hpp>

#include <type_traits>
#include <utility>

/// Receivers of the progress of an integration. Each call returns whether to continue:
///
///   start(solver)           once
///   step(solver)            the last step is valid to its end
///   before(solver, t, x)    the last step is valid to an event that ends it, with the state x
///   after(solver, t, x)     the state after a reset
///
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

/// Calls an observer at the times of samples, and before and after resets.
template <class Samples, class S, class X, class Observer>
class sample_observer {
 public:
  sample_observer(const Samples& samples, const S& t_start, const S& t_end, const X& x, Observer& observer)
      : samples_(samples), forward_(t_start < t_end), x_(x), observer_(observer) {}

  template <class Solver>
  bool start(const Solver& solver) {
    return step(solver);
  }
  template <class Solver>
  bool step(const Solver& solver) {
    if (!sample_before(solver, solver.time())) return false;
    while (is_next(solver.time())) {
      ++next_;
      if (!tell(observer_, solver.time(), solver.state())) return false;
    }
    return true;
  }
  template <class Solver>
  bool before(const Solver& solver, const S& t, const X& x) {
    if (!sample_before(solver, t)) return false;
    while (is_next(t)) ++next_;
    return tell(observer_, t, x);
  }
  template <class Solver>
  bool after(const Solver&, const S& t, const X& x) {
    return tell(observer_, t, x);
  }
  /// Samples get the nearest state.
  bool skip(const S& t, const X& x, const S& t2, const X& x2) {
    while (next_ < samples_.count()) {
      const S sample = samples_[next_];
      if (forward_ ? sample >= t2 : sample <= t2) break;
      ++next_;
      if (!tell(observer_, sample, sample - t < t2 - sample ? x : x2)) return false;
    }
    while (is_next(t2)) ++next_;
    return true;
  }
  template <class Solver>
  bool settle(Solver& solver) {
    if (stopped_within_) solver.restart(samples_[next_ - 1], x_);
    return stopped_within_;
  }

 private:
  bool is_next(const S& t) const { return next_ < samples_.count() && samples_[next_] == t; }
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
  bool forward_, stopped_within_ = false;
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
                                                  solver.state(), observer);
}

}  // namespace kte::detail
