#pragma once

#include <kte/integrators/motion_space.hpp>
#include <kte/integrators/time_grid.hpp>

#include <cmath>
#include <utility>

namespace kte {

/// What an integration has cost so far.
struct step_statistics {
  long long steps = 0;        ///< accepted
  long long rejected = 0;     ///< tried and thrown away
  long long evaluations = 0;  ///< of the right-hand side, also those for differences
  long long jacobians = 0;    ///< of the right-hand side
  long long factorizations = 0;
};

/// What all integrators of x' = f(t, x) share: time and state, observers, samples, the last step.
///
/// X: the state, an Eigen column vector of fixed or dynamic size, of any real scalar S. F: called as f(t, x), returns
/// x' as anything that can be assigned to an X, or to an F::rate where states have rotations (`moves_on_group`). It is
/// copied; pass `std::ref(f)` to share it. Nothing is allocated for a fixed size; for a dynamic size nothing after the
/// first step, but by f itself, which may return a reference to a vector that it keeps.
///
/// A method derives from this with itself as `Method` and has three functions:
///
///   start(t_end)      called once before the steps of an `integrate`; f may have changed since the last one
///   advance(t_end)    one step towards t_end and not beyond: leaves the new state in `next_` and calls `accept`
///   dense(theta, x)   the state x at the fraction 0 < theta < 1 of the last step
///
/// They move by displacements from the state at the start of the step: `displace`, `slope` and, in `dense`,
/// `displaced`. For vectors that is adding.
template <class Method, class F, class X>
class integrator {
 public:
  using S = typename X::Scalar;
  using rate = rate_of<F, X>;
  static_assert(X::ColsAtCompileTime == 1, "kte: a state is a column vector");
  static_assert(std::invocable<F&, const S&, const X&>, "kte: a right-hand side is called as f(t, x)");

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
    if (t_end != time_) method().start(t_end);
  }
  void step(const S& t_end) { method().advance(t_end); }

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

  /// Goes on from another time and state, for instance after an impact. Throws `bad_argument` unless they are finite.
  template <class V>
  void restart(const S& t, const Eigen::MatrixBase<V>& x) {
    detail::check_finite(t, "start time");
    if (x.size() == 0) detail::raise<bad_argument>("kte: the start state is empty");
    for (Eigen::Index i = 0; i < x.size(); ++i) detail::check_finite(S(x[i]), "start state");
    x_ = next_ = previous_ = x;
    time_ = previous_time_ = t;
    if constexpr (on_group) d_ = no_rate();
  }

 protected:
  /// Whether states are no vectors.
  static constexpr bool on_group = moves_on_group<detail::unwrapped_type<F>, X>;
  struct nothing {};
  template <class T>
  using if_on_group = std::conditional_t<on_group, T, nothing>;

  template <class V>
  integrator(F f, const S& t0, const Eigen::MatrixBase<V>& x0) : f_(std::move(f)) {
    restart(t0, x0);
  }

  /// The right-hand side.
  auto& system() { return detail::unwrapped(f_); }
  const auto& system() const { return detail::unwrapped(f_); }
  /// How many numbers rates have.
  Eigen::Index rates() const {
    if constexpr (on_group) {
      return system().rates();
    } else {
      return x_.size();
    }
  }
  /// All zero.
  rate no_rate() const { return rate::Zero(rates()); }

  /// x_dot = f(t, x).
  void evaluate(const S& t, const X& x, rate& x_dot) const {
    ++statistics_.evaluations;
    x_dot = f_(t, x);
    if (x_dot.size() != rates()) [[unlikely]]
      detail::raise<bad_argument>("kte: the right-hand side gave " + std::to_string(x_dot.size()) +
                                  " numbers for a state of " + std::to_string(x.size()));
  }
  /// next_ = state (+) d, where d is an expression of rates.
  template <class D>
  void displace(const D& d) {
    if constexpr (on_group) {
      d_ = d;
      system().displace(x_, d_, next_);
    } else {
      next_ = x_ + d;
    }
  }
  /// The rate of the displacement at its present value, of which `next_` is the state.
  void slope(const S& t, rate& k) {
    evaluate(t, next_, k);
    pull_back(k);
  }
  /// The rate of the state at `next_` becomes that of the displacement.
  void pull_back(rate& k) const {
    if constexpr (on_group) system().pull_back(d_, k);
  }
  /// x = state at the start of the last step (+) d.
  template <class D>
  void displaced(const D& d, X& x) const {
    if constexpr (on_group) {
      rate as_vector = d;
      system().displace(previous_, as_vector, x);
    } else {
      x = previous_ + d;
    }
  }
  /// The rate of the displacement from the start of the last step, where it is d: for a `dense` that needs evaluations.
  /// Overwrites `next_`.
  template <class D>
  void slope_within(const S& t, const D& d, rate& k) const {
    displaced(d, next_);
    evaluate(t, next_, k);
    if constexpr (on_group) {
      const rate as_vector = d;
      system().pull_back(as_vector, k);
    }
  }
  /// The displacement of the last step; of this one before `accept`.
  decltype(auto) displacement() const {
    if constexpr (on_group) {
      return (d_);
    } else {
      return x_ - previous_;
    }
  }
  /// What relative tolerances are relative to.
  decltype(auto) magnitudes(const X& x) const {
    if constexpr (on_group) {
      rate m = no_rate();
      system().magnitudes(x, m);
      return m;
    } else {
      return (x);
    }
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

  /// Whether `next_` has finite numbers only.
  bool next_is_finite() const { return ((next_ - next_).array() == S(0)).all(); }

  X x_, previous_;
  mutable X next_;
  S time_{}, previous_time_{};
  mutable step_statistics statistics_;

 private:
  Method& method() { return static_cast<Method&>(*this); }

  bool in_last_step(const S& t) const {
    return previous_time_ < time_ ? previous_time_ <= t && t <= time_ : time_ <= t && t <= previous_time_;
  }
  mutable std::remove_const_t<F> f_;
  [[no_unique_address]] if_on_group<rate> d_;  ///< from x_ to next_
};

}  // namespace kte
