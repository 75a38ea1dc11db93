#pragma once

#include <kte/integrators/moving_state.hpp>

#include <cmath>

namespace kte {

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

  /// Integrates to t_end, forward or backward; afterwards `time() == t_end`. Throws `integration_failure` that says
  /// where and why it stopped, `bad_argument` for a t_end that is not finite.
  void integrate(const S& t_end) {
    integrate(t_end, [](const S&, const X&) {});
  }
  /// The same; calls observer(t, x) at the start and after every step.
  template <std::invocable<const S&, const X&> Observer>
  void integrate(const S& t_end, Observer&& observer) {
    begin(t_end);
    observer(time_, x_);
    while (time_ != t_end) {
      step(t_end);
      observer(time_, x_);
    }
  }
  /// The same; calls observer(t, x) at the times of a `time_grid`: t0, t0 + h, t0 + 2h, ..., t_end, with t0 the time at
  /// the call. The steps are as without samples; those between step ends are interpolated.
  template <class T, std::invocable<const S&, const X&> Observer>
  void integrate(const S& t_end, const every<T>& spacing, Observer&& observer) {
    begin(t_end);
    const time_grid<S> samples(time_, t_end, S(spacing.spacing), "spacing of samples");
    X x = x_;
    observer(time_, x_);
    for (long long i = 1; time_ != t_end;) {
      step(t_end);
      for (; i <= samples.intervals() && in_last_step(samples[i]); ++i) {
        interpolate(samples[i], x);
        observer(samples[i], x);
      }
    }
  }

  /// One step at a time, for loops of one's own: `begin` once, then `step` until `time()` is t_end, for the same t_end.
  void begin(const S& t_end) {
    detail::check_finite(t_end, "end time");
    is_new_ = is_new_ || in_step_;
    in_step_ = false;
    if (t_end != time_) no_number_is_failure([&] { method().start(t_end); });
  }
  void step(const S& t_end) {
    if (in_step_) [[unlikely]]
      begin(t_end);  // anew: the last step has failed
    in_step_ = true;
    no_number_is_failure([&] { method().advance(t_end); });
    in_step_ = is_new_ = false;
  }

  /// The state at a time of the last step; exact at its ends. Throws `bad_argument` for other times.
  X interpolate(const S& t) const {
    X x = x_;
    interpolate(t, x);
    return x;
  }

  /// The same into x, without a new vector.
  void interpolate(const S& t, X& x) const {
    if (!in_last_step(t)) [[unlikely]]
      detail::raise<bad_argument>("kte: cannot interpolate at t = " + detail::number(static_cast<double>(t)) +
                                  ": the last step goes from " + detail::number(static_cast<double>(previous_time_)) +
                                  " to " + detail::number(static_cast<double>(time_)));
    if (t == time_) {
      x = x_;
    } else if (t == previous_time_) {
      x = previous_;
    } else {
      static_cast<const Method&>(*this).dense(S((t - previous_time_) / (time_ - previous_time_)), x);
    }
  }

  /// Goes on from another time and state; how long steps should be is found out anew. Throws `bad_argument` unless they
  /// are finite.
  template <class V>
  void restart(const S& t, const Eigen::MatrixBase<V>& x) {
    restart(t, x, keep_step);
    is_new_ = true;
  }
  /// The same, but begins with a step as long as the last one: where the motion is as fast as before, for instance
  /// after an impact. `solver.restart(t, x, kte::keep_step)`.
  template <class V>
  void restart(const S& t, const Eigen::MatrixBase<V>& x, keep_step_t) {
    detail::check_finite(t, "start time");
    if (x.size() == 0) detail::raise<bad_argument>("kte: the start state is empty");
    for (Eigen::Index i = 0; i < x.size(); ++i) detail::check_finite(S(x[i]), "start state");
    this->place(x);
    time_ = previous_time_ = t;
  }

 protected:
  template <class V>
  integrator(F f, const S& t0, const Eigen::MatrixBase<V>& x0) : base(std::move(f)) {
    restart(t0, x0);
  }

  /// Ends a step: `next_` is the state at t.
  void accept(const S& t) {
    previous_time_ = time_;
    time_ = t;
    previous_.swap(x_);
    x_.swap(next_);
    ++statistics_.steps;
  }
  [[noreturn, gnu::cold, gnu::noinline]] void fail(const std::string& why) const {
    detail::raise<integration_failure>("kte: integration stopped at t = " + detail::number(static_cast<double>(time_)) +
                                       ": " + why);
  }
  /// Throws where f is not a number at the present time and state.
  void check_finite_slope(const rate& slope) const {
    if (!((slope - slope).array() == S(0)).all()) [[unlikely]]
      fail("the right-hand side is not a finite number");
  }
  /// Tries a step: try_step() gives a `detail::attempt`, here one without a new state where f cannot be computed.
  template <class Try>
  auto attempted(const Try& try_step) const {
    decltype(try_step()) tried{std::numeric_limits<S>::quiet_NaN()};
    this->computes([&] { tried = try_step(); }, this->next_);
    return tried;
  }
  /// For those who choose steps: `fail`, and of numbers that are not finite also the reason.
  auto failing() const {
    return [this](const std::string& why, bool not_finite) { fail(not_finite ? why + this->reason() : why); };
  }

  using base::next_;
  using base::previous_;
  using base::statistics_;
  using base::x_;
  S time_{}, previous_time_{};
  bool is_new_ = true;

 private:
  Method& method() { return static_cast<Method&>(*this); }

  /// Where body() cannot be computed, the integration fails, with the reason.
  template <class Body>
  void no_number_is_failure(const Body& body) {
    this->forget_reason();
    if (!this->computes(body, x_)) [[unlikely]]
      fail("f cannot be computed" + this->reason());
  }

  bool in_last_step(const S& t) const {
    return previous_time_ < time_ ? previous_time_ <= t && t <= time_ : time_ <= t && t <= previous_time_;
  }

  bool in_step_ = false;  ///< also after a step that has failed
};

}  // namespace kte
