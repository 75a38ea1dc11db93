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

/// See `integrator::restart`.
struct keep_step_t {};
inline constexpr keep_step_t keep_step{};

/// What all integrators of x' = f(t, x) share: time and state, observers, samples, the last step.
///
/// X: the state, an Eigen column vector of fixed or dynamic size, of any real scalar S. F: called as f(t, x), returns
/// x' as anything that can be assigned to an X, or to an F::rate where states have rotations (`moves_on_group`). It is
/// copied; pass `std::ref(f)` to share it. Nothing is allocated for a fixed size; for a dynamic size nothing after the
/// first step, but by f itself, which may return a reference to a vector that it keeps.
///
/// A method derives from this with itself as `Method` and has three functions:
///
///   start(t_end)      called once before the steps of an `integrate`; f may have changed since the last one; where
///                     `is_new_`, nothing is known of how long steps should be: at first, after `restart`, after a
///                     step that has failed
///   advance(t_end)    one step towards t_end and not beyond: leaves the new state in `next_` and calls `accept`
///   dense(theta, x)   the state x at the fraction 0 < theta < 1 of the last step
///   degree()          of the polynomial in theta that the displacement is there
///
/// They move by displacements from the state at the start of the step: `displace`, `slope` and, in `dense`,
/// `displaced`. For vectors that is adding.
template <class Method, class F, class X>
class integrator : public moving_state<F, X> {
  using base = moving_state<F, X>;

 public:
  using typename base::rate;
  using typename base::S;

  const S& time() const { return time_; }
  /// The state at `time()`. After a failure: the last good one.
  const X& state() const { return x_; }
  const step_statistics& statistics() const { return statistics_; }
  /// The right-hand side, as it was given.
  using base::function;

  /// Integrates to t_end, forward or backward; afterwards `time() == t_end`. Throws `integration_failure` that says
  /// where and why it stopped, `bad_argument` for a t_end that is not finite or infinitely far.
  stop_reason integrate(const S& t_end) { return travel(t_end, detail::no_stops{}, detail::no_observer{}); }
  /// The same; calls observer(t, x) at the start and after every step. Where it returns `kte::stop`, of type bool, the
  /// integration ends there: at its time and state.
  template <detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, observer));
  }
  /// The same; calls observer(t, x) at the times of a `time_grid`: t0, t0 + h, t0 + 2h, ..., t_end, with t0 the time at
  /// the call. The steps are as without samples; those between step ends are interpolated.
  template <class T, detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, const every<T>& spacing, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, spacing, observer));
  }
  /// The same at the times of a list.
  template <class T, detail::observes<S, X> Observer>
  stop_reason integrate(const S& t_end, const at<T>& times, Observer&& observer) {
    return travel(t_end, detail::no_stops{}, detail::follower_of(method(), t_end, times, observer));
  }
  /// All of the above with steps that end exactly at these times, where f may jump:
  ///
  ///   solver.integrate(10.0, kte::through{1.0, 2.5}, kte::every(0.01), observer)
  template <class T, class... Observed>
  stop_reason integrate(const S& t_end, const through<T>& stops, Observed&&... observed) {
    return travel(t_end, stops, detail::follower_of(method(), t_end, observed...));
  }
  /// Integrates to t_end, or to a terminal event, whose time and state are those of the solver then; observers as
  /// above, called also at events that act: with the state before and, where there is a reset, again with the state
  /// after it. A sample at the very time of such an event is these two. Events that do not act leave the steps as they
  /// are. Gives an `event_report` (kte/events/events.hpp):
  ///
  ///   auto ground = kte::event(height, kte::crossing::falling).reset(bounce).rest(lie);
  ///   auto report = solver.integrate(10.0, kte::events(ground, wall), kte::every(0.01), observer);
  ///
  /// Throws also `integration_failure` for a function of an event that is not a finite number.
  template <class Sink, class... E, class... Observed>
  auto integrate(const S& t_end, event_list<Sink, E...> events, Observed&&... observed) {
    return detail::integrate_with_events(method(), t_end, std::move(events), observed...);
  }

  /// One step at a time, for loops of one's own: `begin` once, then `step` until `time()` is t_end, for the same t_end.
  void begin(const S& t_end);
  void step(const S& t_end);

  /// The state at a time of the last step; exact at its ends. Throws `bad_argument` for other times.
  X interpolate(const S& t) const {
    X x = x_;
    interpolate(t, x);
    return x;
  }

  /// The same into x, without a new vector.
  void interpolate(const S& t, X& x) const;

  // ---- the last step, for `solution`
  const S& previous_time() const { return previous_time_; }
  const X& previous_state() const { return previous_; }
  /// Of the polynomial in time that the dense output of the last step is.
  int dense_degree() const { return static_cast<const Method&>(*this).degree(); }
  /// The displacement from the start of the last step to the fraction 0 <= theta <= 1 of it.
  rate displacement_to(const S& theta) const;

  /// Goes on from another time and state; how long steps should be is found out anew. Throws `bad_argument` unless they
  /// are finite.
  void restart(const S& t, const X& x) {
    restart(t, x, keep_step);
    is_new_ = true;
  }
  /// The same, but begins with a step as long as the last one: where the motion is as fast as before, for instance
  /// after an impact. `solver.restart(t, x, kte::keep_step)`.
  void restart(const S& t, const X& x, keep_step_t);

 protected:
  integrator(F f, const S& t0, const X& x0) : base(std::move(f)) {
    static_assert(!detail::changes_when_called<F, S, X>,
                  "kte: this right-hand side changes when it is called: pass std::ref(f), not std::cref(f)");
    static_assert(base::is_called || detail::changes_when_called<F, S, X>,
                  "kte: a right-hand side is called as f(t, x)");
    restart(t0, x0);
  }

  /// Ends a step: `next_` is the state at t.
  void accept(const S& t) {
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
  /// The text goes on with why f could not be computed in the last tries, if it could not.
  [[noreturn, gnu::cold, gnu::noinline]] void fail(const std::string& why, failure_reason reason) const {
    const double t = detail::as_double(time_);
    const bool not_finite = reason == failure_reason::not_finite;
    long long component = -1;
    for (Eigen::Index i = next_.size(); not_finite && i-- > 0;)
      if (!detail::is_finite(S(next_[i]))) component = i;
    detail::raise<integration_failure>(
        "kte: integration stopped at t = " + detail::number(t) + ": " + why +
            (not_finite || this->cause().empty() ? this->reason() : "; beyond, f cannot be computed" + this->reason()),
        t, reason, this->cause(), component);
  }
  /// Throws where f is not a number at the present time and state.
  void check_finite_slope(const rate& slope) const {
    if (!detail::all_finite(slope)) [[unlikely]]
      fail("the right-hand side is not a finite number", failure_reason::not_finite);
  }
  /// Tries a step: try_step() gives a `detail::attempt`, here one without a new state where f cannot be computed.
  template <class Try>
  auto attempted(const Try& try_step) const {
    return this->computed(try_step, decltype(try_step()){std::numeric_limits<S>::quiet_NaN()}, this->next_);
  }
  /// How many times the tolerances the error of a try is compared with; arguments as of `rounding_floor`.
  template <class Slope, class Rounding>
  [[gnu::noinline]] S level_of_rounding(detail::rounding_floor<S>& floor, const S& error, const S& reach,
                                        const Slope& slope, const Rounding& rounding) const {
    using std::abs;
    return floor.level(error, abs(reach), statistics_.steps + statistics_.rejected, slope, rounding);
  }
  /// The rate n roundings away from the present time and state, `here` being the one there; no number where f cannot be
  /// computed.
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
  /// How much f differs between i and j roundings away from the present time and state, where it is `here`.
  rate rounding_of_rate(int i, int j, const rate& here) const {
    return rate_roundings_away(j, here) - rate_roundings_away(i, here);
  }
  /// For those who choose steps.
  auto failing() const {
    return [this](const std::string& why, failure_reason reason) { fail(why, reason); };
  }

  using base::next_;
  using base::previous_;
  using base::statistics_;
  using base::x_;
  S time_{}, previous_time_{};
  bool is_new_ = true;
  /// Whether t is between the ends of the last step: after a start, only where it began.
  bool in_last_step(const S& t) const {
    return previous_time_ < time_ ? previous_time_ <= t && t <= time_ : time_ <= t && t <= previous_time_;
  }

 private:
  Method& method() { return static_cast<Method&>(*this); }

  /// Where body() cannot be computed, the integration fails, with the reason.
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

  bool in_step_ = false;  ///< also after a step that has failed
};

template <class Method, class F, class X>
void integrator<Method, F, X>::begin(const S& t_end) {
  detail::check_finite(t_end, "end time");
  detail::check_finite(S(t_end - time_), "the way to the end time");
  is_new_ = is_new_ || in_step_;
  in_step_ = false;
  if (t_end == time_) return;
  no_number_is_failure([&] {
    this->begin_at_state();
    method().start(t_end);
  });
}
template <class Method, class F, class X>
void integrator<Method, F, X>::step(const S& t_end) {
  if (in_step_) [[unlikely]]
    begin(t_end);  // anew: the last step has failed
  in_step_ = true;
  no_number_is_failure([&] {
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
    static_cast<const Method&>(*this).dense(S((t - previous_time_) / (time_ - previous_time_)), x);
  }
}
template <class Method, class F, class X>
auto integrator<Method, F, X>::displacement_to(const S& theta) const -> rate {
  if (theta == S(0)) return this->no_rate();
  X x = x_;
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
  for (Eigen::Index i = 0; i < x.size(); ++i) detail::check_finite(S(x[i]), "start state");
  this->place(x);
  time_ = previous_time_ = t;
}

/// `solver.integrate(t_end, ...)`.
template <class Method, class F, class X, class... How>
auto integrate(integrator<Method, F, X>& solver, const std::type_identity_t<typename X::Scalar>& t_end, How&&... how) {
  return static_cast<Method&>(solver).integrate(t_end, std::forward<How>(how)...);
}

}  // namespace kte
