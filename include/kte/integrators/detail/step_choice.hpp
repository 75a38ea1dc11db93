#pragma once

#include <kte/integrators/detail/step_control.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace kte::detail {

/// The reason why a step is not possible; the text is null if it is.
struct obstacle {
  const char* text = nullptr;
  failure_reason reason = failure_reason::not_finite;
  explicit operator bool() const { return text != nullptr; }
};
inline constexpr obstacle not_finite{"the next state or its derivative is not a finite number"};
inline constexpr obstacle diverging{"Newton's iterations do not converge", failure_reason::no_convergence};
inline constexpr obstacle singular{"the matrix of Newton's iterations is singular", failure_reason::singular_matrix};

/// The result of trying a step.
template <class S>
struct attempt {
  S error;  ///< its norm, or the square; accepted if at most 1. Not finite: there is no new state, because of
            ///< `obstacle`
  detail::obstacle obstacle = not_finite;
  S next{0};  ///< length of the next step, or try, that the method proposes; 0: chosen by the error
};

/// Chooses the steps of an integrator by their errors, and reaches the end without a tiny last step.
template <class S>
class step_choice {
 public:
  /// order_of_error: of the error in h. A step that could grow by less than the factor keep_below is kept, with the
  /// factorization of its matrix.
  explicit step_choice(int order_of_error, const S& keep_below = S(1))
      : order_of_error_(order_of_error), control_(order_of_error), keep_below_(keep_below) {}

  /// For a new `integrate` with n components.
  void start(const tolerances<S>& tol, Eigen::Index n) {
    tries_ = 0;
    within_reach_ = tol.are_within_reach(n);
  }
  /// The proposed length of the next step.
  const S& proposed() const { return step_; }
  /// The proposed step, with the sign of the direction from t to t_end.
  S proposed(const S& t, const S& t_end) const { return t_end < t ? S(-step_) : step_; }

  /// Chooses the first step from t to t_end. f0: slope at t. sizes: of the state. slope_after(h): slope after an Euler
  /// step h. fail(why, reason): throws.
  template <class R, class X, class Slope, class Fail>
  void choose_first(const S& t, const S& t_end, const tolerances<S>& tol, const R& f0, const X& sizes,
                    const Slope& slope_after, const Fail& fail) {
    using std::abs;
    check_reach(tol, sizes, fail);
    const S d0 = error_norm(tol, sizes, sizes, sizes), d1 = error_norm(tol, f0, sizes, sizes);
    if (!is_finite(d1)) [[unlikely]] {
      if (const std::string why = tol.too_small(sizes, f0); all_finite(f0) && !why.empty())
        fail(why, failure_reason::out_of_reach);
      fail("the right-hand side is not a finite number", failure_reason::not_finite);
    }
    if (tol.initial_step != S(0)) {
      step_ = tol.initial_step;
      control_ = step_controller<S>(order_of_error_);
      return;
    }
    const S span = abs(S(t_end - t)), least = 4 * least_step(t, span);
    const S trial = trial_step(d0, d1), h0 = span < trial ? span : trial < least ? least : trial;
    const S h = t_end < t ? S(-h0) : h0;
    const S d2 = error_norm(tol, (slope_after(h) - f0) / h, sizes, sizes);
    const S first = first_step(h0, d1, d2, order_of_error_);
    step_ = within(first < least ? least : first, tol);
    control_ = step_controller<S>(order_of_error_);
  }

  /// Tries steps from t towards t_end until one is accepted; returns its end. sizes(): of the state at t.
  /// try_step(end): an `attempt`. rejected: incremented for each rejected try. fail: as above.
  template <class Sizes, class Try, class Fail>
  S take(const S& t, const S& t_end, const tolerances<S>& tol, const Sizes& sizes, long long& rejected,
         const Try& try_step, const Fail& fail) {
    begin_step();
    while (true) {
      const S end = propose(t, t_end, tol, sizes, fail);
      if (judge(try_step(end), tol)) return end;
      ++rejected;
    }
  }
  // ---- the parts of `take`, for lanes of packs
  /// A step from a new time begins.
  void begin_step() { again_ = false, tried_ = {S(0)}; }
  /// The end of the next try.
  template <class Sizes, class Fail>
  S propose(const S& t, const S& t_end, const tolerances<S>& tol, const Sizes& sizes, const Fail& fail) {
    using std::abs;
    if (!again_ && !within_reach_) [[unlikely]]
      check_reach(tol, sizes(), fail);
    const S rest = abs(S(t_end - t)), least = least_step(t, rest);
    const bool last = rest <= stretched(tol);  // avoids a tiny last step: stretches by 1/100, or halves the rest
    h_ = last ? rest : rest < 2 * step_ ? S(rest / 2) : step_;
    if (!last && (h_ < least || step_ < tol.smallest_step)) [[unlikely]]
      fail(too_short(step_ < tol.smallest_step ? step_ : h_, tol.smallest_step, tried_), reason_of(tried_));
    if (tries_++ == tol.max_steps) [[unlikely]]
      fail("max_steps = " + std::to_string(tol.max_steps) + " steps are used up", failure_reason::too_many_steps);
    return last ? t_end : t_end < t ? S(t - h_) : S(t + h_);
  }
  /// Whether the try is accepted; chooses the next step or try.
  bool judge(const attempt<S>& tried, const tolerances<S>& tol) {
    if (tried.error <= S(1)) {
      step_ = within(tried.next != S(0) ? tried.next : after(h_, control_.accepted(tried.error, again_)), tol);
      return true;
    }
    step_ = tried.next != S(0) ? tried.next : S(h_ * control_.rejected(tried.error));
    again_ = true, tried_ = tried;
    return false;
  }

 private:
  template <class X, class Fail>
  [[gnu::noinline]] void check_reach(const tolerances<S>& tol, const X& sizes, const Fail& fail) const {
    if (const std::string why = tol.out_of_reach(sizes); !why.empty()) fail(why, failure_reason::out_of_reach);
  }
  /// h within the smallest and largest step.
  static S within(const S& h, const tolerances<S>& tol) {
    return h < tol.smallest_step                              ? tol.smallest_step
           : tol.largest_step != S(0) && tol.largest_step < h ? tol.largest_step
                                                              : h;
  }
  S stretched(const tolerances<S>& tol) const {
    const S h = S(1.01) * step_;
    return tol.largest_step != S(0) && tol.largest_step < h ? tol.largest_step : h;
  }
  /// The step after an accepted step of length h, whose error suggests a change by `factor`.
  S after(const S& h, const S& factor) const {
    const S next = h * (S(1) < factor && factor < keep_below_ ? S(1) : factor);
    return h < step_ && next < step_ ? step_ : next;  // a step cut short says nothing about the next
  }
  /// The shortest step: a few ulp of the time. At time 0, a fraction of `rest`, and never a subnormal number.
  static S least_step(const S& time, const S& rest) {
    using std::abs;
    const S eps = std::numeric_limits<S>::epsilon(), t = abs(time), at_zero = eps * rest;
    const S least = 4 * eps * (t < at_zero ? at_zero : t), normal = (std::numeric_limits<S>::min)();
    return least < normal ? normal : least;
  }
  [[gnu::cold, gnu::noinline]] static std::string too_short(const S& h, const S& smallest, const attempt<S>& tried) {
    if (!is_finite(tried.error)) return std::string(tried.obstacle.text) + ", however short the step";
    const std::string needed = "the tolerances need a step of " + number(static_cast<double>(h));
    return h < smallest ? needed + ", below the smallest step " + number(static_cast<double>(smallest))
                        : needed + ", which is lost in the rounding of t";
  }
  static failure_reason reason_of(const attempt<S>& tried) {
    return is_finite(tried.error) ? failure_reason::step_too_short : tried.obstacle.reason;
  }

  int order_of_error_;
  step_controller<S> control_;
  S keep_below_;
  S step_{0};               ///< proposed length of the next step
  S h_{0};                  ///< length of the present try
  attempt<S> tried_{S(0)};  ///< the last try, if it was rejected
  bool again_ = false;      ///< whether a try from the present time has been rejected
  long long tries_ = 0;
  bool within_reach_ = true;  ///< whether the tolerances are within reach for all states
};

}  // namespace kte::detail
