#pragma once

#include <kte/integrators/detail/followers.hpp>
#include <kte/integrators/detail/rounding_floor.hpp>
#include <kte/integrators/moving_state.hpp>

#include <cmath>

namespace kte {

template <class Sink, class... E>
struct event_list;
namespace detail {
template <class Solver, class Sink, class... E, class... Observed>
auto integrate_with_events(Solver&, const typename Solver::S&, event_list<Sink, E...>, Observed&&...);
template <class Observer, class S, class X>
concept observes = follower<std::remove_reference_t<Observer>> || std::invocable<Observer, const S&, const X&>;
}  // namespace detail

/// The type of `keep_step`, an argument of `integrator::restart`.
struct keep_step_t {};
/// Argument of `integrator::restart`: keeps the length of the step.
inline constexpr keep_step_t keep_step{};

/// Base of all integrators of x' = f(t, x): holds time and state, calls observers, keeps the last step for dense
/// output.
///
/// X: the state, an Eigen column vector of fixed or dynamic size, of any real scalar S. Explicit Runge-Kutta methods
/// also integrate packs: one state in each lane, all at the same times, which are then numbers of type S of one lane.
/// F: called as f(t, x), returns x' as anything that can be assigned to an X, or to an F::rate where states have
/// rotations (`moves_on_group`). f is copied; pass `std::ref(f)` to share it. A fixed size allocates nothing. A dynamic
/// size allocates nothing after the first step, except in f itself, which may return a reference to a vector that it
/// keeps.
///
/// A method derives from this class with itself as `Method` and has four functions:
///
///   start(t_end)      called once before the steps of an `integrate`; f may have changed since the last one. Where
///                     `is_new_`, a suitable step is unknown: at first, after `restart`, after a failed step
///   advance(t_end)    one step towards t_end and not beyond: stores the new state in `next_` and calls `accept`
///   dense(theta, x)   the state x at the fraction 0 < theta < 1 of the last step
///   degree()          of the displacement as a polynomial in theta
///
/// Methods work with displacements from the state at the start of the step: `displace`, `slope` and, in `dense`,
/// `displaced`. For vectors these are additions.
template <class Method, class F, class X>
class integrator : public moving_state<F, X> {
  using base = moving_state<F, X>;

 public:
  using typename base::rate;
  using typename base::S;

  /// The present time, s.
  [[nodiscard]] const S& time() const { return time_; }
  /// The state at `time()`; after a failure the last valid one.
  [[nodiscard]] const X& state() const { return x_; }
  /// Counts of steps and evaluations so far.
  [[nodiscard]] const step_statistics& statistics() const { return statistics_; }
  /// The right-hand side.
  using base::function;

  /// Integrates to t_end, forward or backward; afterwards `time() == t_end`. Throws `integration_failure` with the time
  /// and reason of the failure, `bad_argument` for a t_end that is not finite.
  stop_reason integrate(const S& t_end) { return travel(t_end, detail::no_stops{}, detail::no_observer{}); }
  /// Integrates to t_end and calls observer(t, x) at the start and after every step. If the observer returns
  /// `kte::stop`, of type bool, the integration ends at its time and state.
  template <detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, observer));
  }
  /// Integrates to t_end and calls observer(t, x) at the times t0, t0 + h, t0 + 2h, ..., t_end of a `time_grid`; t0 is
  /// the time at the call. Samples do not change the steps; states between step ends are interpolated.
  template <class T, detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, const every<T>& spacing, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, spacing, observer));
  }
  /// Integrates to t_end and calls observer(t, x) at the times of a list.
  template <class T, detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, const at<T>& times, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, times, observer));
  }
  /// Integrates with steps that end exactly at the given times, where f may jump; with or without observer and samples:
  ///
  ///   solver.integrate(10.0, kte::through{1.0, 2.5}, kte::every(0.01), observer)
  template <class T, class... Observed>
  stop_reason integrate(const S& t_end, const through<T>& stops, Observed&&... observed) {
    return travel(t_end, stops, detail::follower_of(method(), t_end, observed...));
  }
  /// Integrates to t_end or to a terminal event; then time and state of the solver are those of the event. An observer
  /// of every step is also called at events that act: with the state before and, if there is a reset, with the state
  /// after it. Observers at `every` and `at` times are called at these times only, at the time of an event with the
  /// state after it; those at `every` times also at a terminal event, the end. With `kte::every(h).with_event_rows()`
  /// also at events, as observers of every step. Events that do not act do not change the steps. Returns an
  /// `event_report` (kte/events/events.hpp):
  ///
  ///   auto ground = kte::event(height, kte::crossing::falling).reset(bounce).rest(lie);
  ///   auto report = solver.integrate(10.0, kte::events(ground, wall), kte::every(0.01), observer);
  ///
  /// Throws `integration_failure` also for an event function that is not finite.
  template <class Sink, class... E, class... Observed>
  auto integrate(const S& t_end, event_list<Sink, E...> events, Observed&&... observed) {
    return detail::integrate_with_events(method(), t_end, std::move(events), observed...);
  }

  /// Single steps, for custom loops: call `begin` once, then `step` until `time()` is t_end, with one t_end.
  void begin(const S& t_end);
  /// One step towards t_end; see `begin`.
  void step(const S& t_end);

  /// The state at a time of the last step; exact at its ends. Throws `bad_argument` for other times.
  [[nodiscard]] X interpolate(const S& t) const {
    X x = x_;
    interpolate(t, x);
    return x;
  }

  /// Writes the state at a time of the last step into x, without allocation.
  void interpolate(const S& t, X& x) const;

  // ---- the last step, for `solution`
  /// The time at the start of the last step, s.
  [[nodiscard]] const S& previous_time() const { return previous_time_; }
  /// The state at the start of the last step.
  [[nodiscard]] const X& previous_state() const { return previous_; }
  /// The degree in time of the dense output of the last step.
  [[nodiscard]] int dense_degree() const { return static_cast<const Method&>(*this).degree(); }
  /// The displacement from the start of the last step to the fraction 0 <= theta <= 1 of it.
  [[nodiscard]] rate displacement_to(const S& theta) const;

  /// Continues from another time and state. The length of the next step is computed again from the slopes. Throws
  /// `bad_argument` unless t and x are finite.
  void restart(const S& t, const X& x) {
    restart(t, x, keep_step);
    is_new_ = true;
  }
  /// Continues from another time and state with the length of the last step, for motions that stay about as fast, such
  /// as after an impact: `solver.restart(t, x, kte::keep_step)`.
  void restart(const S& t, const X& x, keep_step_t);

 protected:
  integrator(F f, const S& t0, const X& x0) : base(std::move(f)) {
    static_assert(!detail::changes_when_called<F, S, X>,
                  "kte: this right-hand side changes when it is called: pass std::ref(f), not std::cref(f)");
    static_assert(base::is_called || detail::changes_when_called<F, S, X>,
                  "kte: a right-hand side is called as f(t, x)");
    static_assert(
        std::is_same_v<S, typename X::Scalar> || requires { Method::integrates_packs; },
        "kte: of integrators, explicit Runge-Kutta methods integrate packs of states");
    restart(t0, x0);
  }

  /// Ends a step: `next_` is the state at t.
  void accept(const S& t) {
    this->settle_at(t);
    this->settle_next();
    previous_time_ = time_;
    time_ = t;
    if constexpr (X::SizeAtCompileTime == Eigen::Dynamic) {
      previous_.swap(x_);
      x_.swap(next_);
    } else {
      previous_ = x_;
      x_ = next_;
    }
    ++statistics_.steps;
  }
  /// The message includes the reason why f could not be computed in the last tries, if any.
  [[noreturn, gnu::cold, gnu::noinline]] void fail(const std::string& why, failure_reason reason) const {
    const double t = detail::as_double(time_);
    const bool not_finite = reason == failure_reason::not_finite;
    long long component = -1;
    for (Eigen::Index i = next_.size(); not_finite && i-- > 0;)
      if (!detail::is_finite(typename X::Scalar(next_[i]))) component = i;
    detail::raise<integration_failure>(
        "kte: integration stopped at t = " + detail::number(t) + ": " + why +
            (not_finite || this->cause().empty() ? this->reason() : "; beyond, f cannot be computed" + this->reason()),
        t, reason, this->cause(), component);
  }
  /// Throws if f is not finite at the present time and state.
  void check_finite_slope(const rate& slope) const {
    if (!detail::all_finite(slope)) [[unlikely]]
      fail("the right-hand side is not a finite number", failure_reason::not_finite);
  }
  /// Tries a step: try_step() returns a `detail::attempt`. The result has no new state if f cannot be computed.
  template <class Try>
  auto attempted(const Try& try_step) const {
    return this->computed(try_step, decltype(try_step()){std::numeric_limits<S>::quiet_NaN()}, this->next_);
  }
  /// The factor on the tolerances for the error of a try; arguments as in `rounding_floor`.
  template <class Slope, class Rounding>
  [[gnu::noinline]] S level_of_rounding(detail::rounding_floor<S>& floor, const S& error, const S& reach,
                                        const Slope& slope, const Rounding& rounding) const {
    using std::abs;
    return floor.level(error, abs(reach), statistics_.steps + statistics_.rejected, slope, rounding);
  }
  /// The rate n roundings away from the present time and state, where it is `here`; NaN if f cannot be computed.
  rate rate_roundings_away(int n, const rate& here) const {
    if (n == 0) return here;
    using std::abs;
    const S eps = S(n) * std::numeric_limits<S>::epsilon();
    rate r = eps * this->magnitudes(x_);
    for (Eigen::Index i = 0; i < r.size(); i += 2) r[i] = -r[i];
    X x = x_;
    if constexpr (base::on_group) {
      this->system().displace(x_, r, x);
    } else {
      x += r;
    }
    this->evaluate_if_possible(S(time_ + eps * abs(time_)), x, r);
    return r;
  }
  /// The difference of f between i and j roundings away from the present time and state, where it is `here`.
  rate rounding_of_rate(int i, int j, const rate& here) const {
    return rate_roundings_away(j, here) - rate_roundings_away(i, here);
  }
  /// The function object `fail` for classes that choose steps.
  auto failing() const {
    return [this](const std::string& why, failure_reason reason) { fail(why, reason); };
  }

  using base::next_;
  using base::previous_;
  using base::statistics_;
  using base::x_;
  S time_{}, previous_time_{};
  bool is_new_ = true;
  /// Whether t is within the last step; after a start, whether it is the start.
  bool in_last_step(const S& t) const {
    return previous_time_ < time_ ? previous_time_ <= t && t <= time_ : time_ <= t && t <= previous_time_;
  }

 private:
  Method& method() { return static_cast<Method&>(*this); }

  /// Calls body(). If it cannot be computed, the integration fails with this reason.
  template <class Body>
  void no_number_is_failure(const Body& body) {
    this->forget_reason();
    if (!this->computes(body, x_)) [[unlikely]]
      fail("f cannot be computed", failure_reason::not_finite);
  }
  template <class Stops, class Follower>
  stop_reason travel(const S& t_end, const Stops& stops, Follower&& follower) {
    detail::check_finite(t_end, "end time");
    stops.template check<S>(time_, t_end, "stop time");
    S goal = time_;
    std::size_t passed = 0;
    const auto begin_next = [&] {
      goal = t_end;
      if constexpr (!std::is_same_v<Stops, detail::no_stops>) {
        while (passed < stops.count() && S(stops[passed]) == time_) ++passed;
        if (passed < stops.count()) goal = S(stops[passed++]);
      }
      begin(goal);
    };
    begin_next();
    if (!follower.start(method())) return stop_reason::observer;
    while (time_ != t_end) {
      if (time_ == goal) begin_next();
      step(goal);
      if (follower.step(method())) continue;
      follower.settle(method());
      return stop_reason::observer;
    }
    return stop_reason::end_time;
  }

  bool in_step_ = false;  ///< remains true after a failed step
};

template <class Method, class F, class X>
void integrator<Method, F, X>::begin(const S& t_end) {
  detail::check_finite(t_end, "end time");
  detail::check_finite(S(t_end - time_), "the way to the end time");
  is_new_ = is_new_ || in_step_;
  in_step_ = false;
  if (t_end == time_) return;
  no_number_is_failure([&] {
    this->settle_at(time_);
    this->begin_at_state();
    method().start(t_end);
  });
}
template <class Method, class F, class X>
void integrator<Method, F, X>::step(const S& t_end) {
  if (in_step_) [[unlikely]]
    begin(t_end);  // again, because the last step has failed
  in_step_ = true;
  no_number_is_failure([&] {
    this->settle_at(time_);
    this->begin_at_state();
    method().advance(t_end);
  });
  in_step_ = is_new_ = false;
}
template <class Method, class F, class X>
void integrator<Method, F, X>::interpolate(const S& t, X& x) const {
  if (!in_last_step(t)) [[unlikely]]
    detail::raise<bad_argument>("kte: cannot interpolate at t = " + detail::number(detail::as_double(t)) +
                                ": the last step goes from " + detail::number(detail::as_double(previous_time_)) +
                                " to " + detail::number(detail::as_double(time_)));
  if (t == time_) {
    x = x_;
  } else if (t == previous_time_) {
    x = previous_;
  } else {
    this->settle_at(t);
    static_cast<const Method&>(*this).dense(S((t - previous_time_) / (time_ - previous_time_)), x);
  }
}
template <class Method, class F, class X>
auto integrator<Method, F, X>::displacement_to(const S& theta) const -> rate {
  if (theta == S(0)) return this->no_rate();
  X x = x_;
  this->settle_at(S(previous_time_ + theta * (time_ - previous_time_)));
  static_cast<const Method&>(*this).dense(theta, x);
  if constexpr (base::on_group) {
    return this->displacement_within();
  } else {
    return x - previous_;
  }
}
template <class Method, class F, class X>
void integrator<Method, F, X>::restart(const S& t, const X& x, keep_step_t) {
  detail::check_finite(t, "start time");
  if (x.size() == 0) detail::raise<bad_argument>("kte: the start state is empty");
  for (Eigen::Index i = 0; i < x.size(); ++i) detail::check_finite(typename X::Scalar(x[i]), "start state");
  this->place(x);
  time_ = previous_time_ = t;
}

/// The implementation of `solver.integrate(t_end, ...)`.
template <class Method, class F, class X, class... How>
auto integrate(integrator<Method, F, X>& solver, const std::type_identity_t<typename X::Scalar>& t_end, How&&... how) {
  return static_cast<Method&>(solver).integrate(t_end, std::forward<How>(how)...);
}

}  // namespace kte
