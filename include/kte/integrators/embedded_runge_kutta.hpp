#pragma once

#include <kte/integrators/integrator.hpp>
#include <kte/integrators/step_control.hpp>
#include <kte/integrators/tableau.hpp>

namespace kte {

/// An explicit Runge-Kutta method of s stages that judges its error by a second solution and chooses its steps by it:
///
///   k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j)           (1)
///   x1 = x + h sum_j a_sj k_j                              (2)
///   e = h sum_i (a_si - b_i) k_i                           (3)
///
/// The last row of a holds the weights of the solution, so the last stage is the slope at the end of the step and the
/// first stage of the next: one evaluation saved. (A method without this property is written with one stage more, which
/// is its weights again.) Between the ends, the cubic through both states and slopes, which is of order 3, and the
/// tableau's quartic if it has one:
///
///   x(t + theta h) = (1 - theta) x + theta x1
///     + theta (theta - 1) [(1 - 2 theta)(x1 - x) + (theta - 1) h k_1 + theta h k_s]
///     + theta^2 (1 - theta)^2 h sum_i d_i k_i              (4)
///
/// A `Tableau` has `stages`, `order_of_error` (of e in h), `c`, `a`, `embedded` (b_i), and may have `dense` (d_i).
template <class Tableau, class F, class X>
class embedded_runge_kutta : public integrator<embedded_runge_kutta<Tableau, F, X>, F, X> {
  using base = integrator<embedded_runge_kutta, F, X>;
  friend base;
  static constexpr std::size_t stages = Tableau::stages;

 public:
  using typename base::rate;
  using typename base::S;

  /// f(t, x), start time (s), start state, tolerances. Throws `bad_argument` for tolerances that are not positive, and
  /// for a start that is not finite.
  template <class V>
  embedded_runge_kutta(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol = {})
      : base(std::move(f), t0, x0), tolerances_(tol) {
    tol.check(this->rates());
    k_.fill(this->no_rate());
  }

 private:
  void start(const S& t_end) {
    tries_ = 0;
    this->evaluate(this->time_, this->x_, slope_at_end());
    if (step_ == S(0)) step_ = choose_first_step(t_end);
  }

  void advance(const S& t_end) {
    using std::abs;
    begin_step();
    this->previous_time_ = this->time_;  // the stages of the last step are gone
    const S rest = abs(S(t_end - this->time_)), least = least_step(rest);
    S error(0);
    for (bool again = false;; again = true) {
      const bool last = rest <= S(1.01) * step_;  // no tiny last step: stretched by 1/100, or the rest halved
      const S h = last ? rest : rest < 2 * step_ ? S(rest / 2) : step_;
      if (!last && h < least) [[unlikely]]
        fail_at_step(h, error);
      if (tries_++ == tolerances_.max_steps) [[unlikely]]
        this->fail("max_steps = " + std::to_string(tolerances_.max_steps) + " steps are used up");
      const S end = last ? t_end : t_end < this->time_ ? S(this->time_ - h) : S(this->time_ + h);
      error = try_step(end);
      if (error <= S(1)) {
        this->accept(end);
        const S next = h * control_.accepted(error, again);
        step_ = h < step_ && next < step_ ? step_ : next;  // a step cut short says nothing about the next
        return;
      }
      ++this->statistics_.rejected;
      step_ = h * control_.rejected(error);
    }
  }

  /// The last slope is the first one.
  void begin_step() {
    if constexpr (base::on_group) {
      k_.front() = slope_at_end_;
    } else {
      k_.front().swap(k_.back());
    }
  }
  rate& slope_at_end() {
    if constexpr (base::on_group) {
      return slope_at_end_;
    } else {
      return k_.back();
    }
  }

  /// (1) to (3) for the step to `end`. Returns the norm of the error; NaN if the new state is not finite.
  S try_step(const S& end) {
    const S h = end - this->time_;
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(h, end), ...); }
    (std::make_index_sequence<stages - 1>{});
    if (!this->next_is_finite()) return std::numeric_limits<S>::quiet_NaN();
    const auto e = h * detail::difference<Tableau::a.back(), Tableau::embedded>(k_);  // (3)
    return detail::error_norm(tolerances_, e, this->magnitudes(this->x_), this->magnitudes(this->next_));
  }
  template <std::size_t I>
  void stage(const S& h, const S& end) {
    this->displace(h * detail::combination<Tableau::a[I]>(k_));  // (1); at last (2)
    this->evaluate(detail::stage_time<S, Tableau::c[I]>(this->time_, h, end), this->next_, k_[I]);
    if constexpr (base::on_group && I + 1 == stages) slope_at_end_ = k_[I];  // as seen from the next step
    this->pull_back(k_[I]);
  }

  void dense(const S& theta, X& x) const {
    const S h = this->time_ - this->previous_time_, r = S(1) - theta, rt = r * theta;
    const auto& d = this->displacement();
    const auto cubic =
        (theta + rt * (theta - r)) * d + (rt * r * h) * k_.front() - (rt * theta * h) * k_.back();  // (4)
    if constexpr (requires { Tableau::dense; }) {
      this->displaced(cubic + (rt * rt * h) * detail::combination<Tableau::dense>(k_), x);
    } else {
      this->displaced(cubic, x);
    }
  }

  S choose_first_step(const S& t_end) {
    using std::abs;
    const rate& f0 = slope_at_end();
    const auto& x = this->magnitudes(this->x_);
    const S d0 = detail::error_norm(tolerances_, x, x, x), d1 = detail::error_norm(tolerances_, f0, x, x);
    if (!detail::is_finite(d1)) [[unlikely]]
      this->fail("the right-hand side is not a finite number");
    const S span = abs(S(t_end - this->time_)), least = 4 * least_step(span);
    const S trial = detail::trial_step(d0, d1), h0 = span < trial ? span : trial < least ? least : trial;
    const S h = t_end < this->time_ ? S(-h0) : h0;
    this->displace(h * f0);
    this->slope(S(this->time_ + h), k_.front());
    const S d2 = detail::error_norm(tolerances_, (k_.front() - f0) / h, x, x);
    const S first = detail::first_step(h0, d1, d2, Tableau::order_of_error);
    return first < least ? least : first;
  }

  /// A few ulp of the time; with `rest` left to go, more than nothing at time 0.
  S least_step(const S& rest) const {
    using std::abs;
    const S eps = std::numeric_limits<S>::epsilon(), t = abs(this->time_), at_zero = eps * rest;
    return 4 * eps * (t < at_zero ? at_zero : t);
  }
  [[noreturn, gnu::cold, gnu::noinline]] void fail_at_step(const S& h, const S& error) const {
    this->fail(detail::is_finite(error)
                   ? "the tolerances need a step of " + detail::number(static_cast<double>(h)) +
                         ", which is lost in the rounding of t"
                   : "the next state or its derivative is not a finite number, however short the step");
  }

  tolerances<S> tolerances_;
  detail::step_controller<S> control_{Tableau::order_of_error};
  std::array<rate, stages> k_;
  [[no_unique_address]] typename base::template if_on_group<rate> slope_at_end_;
  S step_{0};  ///< length proposed for the next step; 0: none yet
  long long tries_ = 0;
};

}  // namespace kte
