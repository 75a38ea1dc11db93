#pragma once

#include <kte/integrators/bdf_order.hpp>
#include <kte/integrators/bdf_step.hpp>
#include <kte/integrators/step_choice.hpp>

namespace kte {

/// Settings of `bdf`.
struct bdf_settings {
  int max_order = 5;  ///< 1 to 5. To order 2 A-stable; beyond, fast and weakly damped oscillations make steps short
  bdf_formula formula = bdf_formula::numerical_differentiation;
};

/// For stiff systems: backward differentiation formulas of orders 1 to 5, or the numerical differentiation formulas,
/// which are more exact. Order and step change as the errors ask.
///
///   kte::bdf solver(f, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
///   solver.integrate(10.0);
///   solver.integrate(20.0, kte::every(0.001), [](double t, const auto& x) { ... });
///
/// One to two evaluations of f a step, and now and then a Jacobian: f.jacobian(t, x, J) or differences
/// (`implicit_integrator`). Steps stay equal for a while; then the same history is seen with another step
/// (`backward_differences`). Between the ends of a step: the polynomial of its order through the states until its end.
///
/// A step may add a tenth of the tolerances: as the errors of steps sum up, the error in the end is about the
/// tolerance.
///
/// The history goes on from one `integrate` to the next, unless time, state, direction or the slope f(t, x) have
/// changed: then it begins anew with order 1.
///
/// Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997), section 2.
template <class F, class X>
class bdf : public bdf_step<bdf<F, X>, F, X> {
  using base = bdf_step<bdf, F, X>;
  friend integrator<bdf, F, X>;
  static_assert(
      !base::on_group,
      "kte: this method keeps a history of states, which needs states that are vectors: use a one-step method "
      "for stiff systems, or the rates of quaternions as a vector");

 public:
  using typename base::rate;
  using typename base::S;

  /// f(t, x), start time (s), start state, tolerances, settings. Throws `bad_argument` for tolerances that are not
  /// positive, for an order that there is not, and for a start that is not finite.
  template <class V>
  bdf(F f, const S& t0, const Eigen::MatrixBase<V>& x0, const tolerances<S>& tol = {},
      const bdf_settings& settings = {})
      : base(std::move(f), t0, x0, tol, settings.formula), max_order_(settings.max_order) {
    constexpr int most = detail::bdf_coefficients<S>::most;
    if (max_order_ < 1 || max_order_ > most)
      detail::raise<bad_argument>("kte: max_order must be 1 to " + std::to_string(most) + ", got " +
                                  std::to_string(max_order_));
  }

  /// Of the last step.
  int order() const { return order_of_last_; }

 private:
  void start(const S& t_end) {
    tries_ = 0;
    this->evaluate(this->time_, this->x_, this->change_);
    if (continues(t_end)) return;
    this->previous_time_ = this->time_;  // nothing left to interpolate
    this->slope_.swap(this->change_);
    this->slope_is_known_ = true;
    this->jacobian_is_known_ = false;
    detail::step_choice<S> first(2);
    this->choose_first_step(first, t_end, this->slope_, this->change_);
    step_ = first.proposed(this->time_, t_end);
    this->begin_history(step_);
    time_of_history_ = this->time_;
  }
  /// Whether the history leads to the present, and in the direction of t_end. `change_` is the slope now.
  bool continues(const S& t_end) const {
    return this->slope_is_known_ && (t_end < this->time_) == (this->h_ < S(0)) && this->time_ == time_of_history_ &&
           this->x_ == this->differences_[0] && this->change_ == this->slope_;
  }

  void advance(const S& t_end) {
    using std::abs;
    this->previous_time_ = this->time_;  // the differences will be others
    const S rest = t_end - this->time_, least = detail::step_choice<S>::least_step(this->time_, abs(rest));
    this->obstacle_ = nullptr;
    for (;;) {
      const bool last = abs(rest) <= S(1.01) * abs(step_);  // no tiny last step: stretched by 1/100, or the rest halved
      const S h = last ? rest : abs(rest) < 2 * abs(step_) ? S(rest / 2) : step_;
      if (!last && abs(h) < least) [[unlikely]]
        fail_at_step(h);
      if (tries_++ == this->tolerances_.max_steps) [[unlikely]]
        this->fail("max_steps = " + std::to_string(this->tolerances_.max_steps) + " steps are used up");
      const S end = last ? t_end : S(this->time_ + h);
      this->change_step(h);
      if (try_step(end)) {
        finish(end);
        if (last) this->slope_now();  // the next `start` compares
        return;
      }
      ++this->statistics_.rejected;
    }
  }
  /// Leaves the new state in `next_`; or a shorter step to try, or a new Jacobian.
  bool try_step(const S& end) {
    if (!this->solve_formula(end)) {
      step_ = this->jacobian_is_new_ ? S(this->h_ / 4) : this->h_;
      if (!this->jacobian_is_new_) this->renew_jacobian();
      return false;
    }
    const S error = this->error();
    if (error <= S(1)) return true;
    this->obstacle_ = nullptr;
    step_ = this->h_ * detail::shrink_step(this->order_, error);
    return false;
  }
  void finish(const S& end) {
    this->extend_history();
    order_of_last_ = this->order_;
    plan();
    this->accept(end);
    time_of_history_ = end;
  }
  /// The next step, and its order.
  void plan() {
    using std::abs;
    if (abs(step_) <= abs(this->h_)) {
      step_ = this->h_;
    } else if (2 * abs(this->h_) < abs(step_)) {
      step_ = 2 * this->h_;  // cut short, to end where it shall; tells little about much longer steps
    }
    if (this->equal_steps_ <= this->order_) return;  // D^{k+2} needs k + 1 equal steps
    const auto next = detail::choose_order<S>(this->order_, max_order_, [&](int q) { return this->error(q); });
    if (this->order_ != next.order) this->equal_steps_ = 0;
    this->order_ = next.order;
    step_ = this->h_ * next.factor;
  }
  void dense(const S& theta, X& x) const { this->differences_.interpolate(order_of_last_, S(theta - 1), x); }

  [[noreturn, gnu::cold, gnu::noinline]] void fail_at_step(const S& h) const {
    using std::abs;
    this->fail(this->obstacle_ ? std::string(this->obstacle_) + ", however short the step"
                               : "the tolerances need a step of " + detail::number(static_cast<double>(abs(h))) +
                                     ", which is lost in the rounding of t");
  }

  S step_{0};  ///< proposed for the next step, with its sign
  S time_of_history_{0};
  long long tries_ = 0;
  int max_order_, order_of_last_ = 1;
};

template <class F, class V>
bdf(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&, const tolerances<typename V::Scalar>& = {},
    const bdf_settings& = {}) -> bdf<F, typename V::PlainObject>;

}  // namespace kte
