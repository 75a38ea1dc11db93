#pragma once

#include <kte/integrators/time_grid.hpp>

#include <utility>

/// Observers of an integration with events. They are told
///
///   start(t, x)             once
///   step(solver)            the last step holds to its end
///   before(solver, t, x)    the last step holds to an event that ends it, with the state x
///   after(t, x)             the state after a reset
namespace kte::detail {

struct no_observer {
  template <class... A>
  void start(const A&...) {}
  template <class... A>
  void step(const A&...) {}
  template <class... A>
  void before(const A&...) {}
  template <class... A>
  void after(const A&...) {}
};

template <class Observer>
class step_observer {
 public:
  explicit step_observer(Observer& observer) : observer_(observer) {}

  template <class S, class X>
  void start(const S& t, const X& x) {
    observer_(t, x);
  }
  template <class Solver>
  void step(const Solver& solver) {
    observer_(solver.time(), solver.state());
  }
  template <class Solver, class S, class X>
  void before(const Solver&, const S& t, const X& x) {
    observer_(t, x);
  }
  template <class S, class X>
  void after(const S& t, const X& x) {
    observer_(t, x);
  }

 private:
  Observer& observer_;
};

/// At the times of a `time_grid`, and before and after resets.
template <class S, class X, class Observer>
class sample_observer {
 public:
  sample_observer(const S& t_start, const X& x, const S& t_end, const S& spacing, Observer& observer)
      : samples_(t_start, t_end, spacing, "spacing of samples"),
        forward_(t_start < t_end),
        x_(x),
        observer_(observer) {}

  void start(const S& t, const X& x) { observer_(t, x); }
  template <class Solver>
  void step(const Solver& solver) {
    sample_before(solver, solver.time());
    if (is_next(solver.time())) {
      ++next_;
      observer_(solver.time(), solver.state());
    }
  }
  template <class Solver>
  void before(const Solver& solver, const S& t, const X& x) {
    sample_before(solver, t);
    if (is_next(t)) ++next_;
    observer_(t, x);
  }
  void after(const S& t, const X& x) { observer_(t, x); }

 private:
  bool is_next(const S& t) const { return next_ <= samples_.intervals() && samples_[next_] == t; }
  template <class Solver>
  void sample_before(const Solver& solver, const S& t) {
    for (; next_ <= samples_.intervals(); ++next_) {
      const S sample = samples_[next_];
      if (forward_ ? sample >= t : sample <= t) break;
      solver.interpolate(sample, x_);
      observer_(sample, x_);
    }
  }

  time_grid<S> samples_;
  bool forward_;
  long long next_ = 1;
  X x_;
  Observer& observer_;
};

}  // namespace kte::detail
