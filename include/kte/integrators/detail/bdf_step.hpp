#pragma once

#include <kte/integrators/detail/backward_differences.hpp>
#include <kte/integrators/detail/bdf_coefficients.hpp>
#include <kte/integrators/detail/newton_progress.hpp>
#include <kte/integrators/detail/weakly_damped.hpp>
#include <kte/integrators/implicit_integrator.hpp>

namespace kte {

/// One step of `bdf` of a given order and length h: solves (2) of `bdf_coefficients` by simplified Newton iterations
///
///   (I - c J) D = c f(t + h, p + d) - sum_j w_j D^j x - d,   d <- d + D                      (1)
///
/// The Jacobian J is kept until the iterations converge slowly; the matrix is kept as long as order and step.
template <class Method, class F, class X>
class bdf_step : public implicit_integrator<Method, F, X> {
  using base = implicit_integrator<Method, F, X>;

 public:
  using typename base::rate;
  using typename base::S;

 protected:
  bdf_step(F f, const S& t0, const X& x0, const tolerances<S>& tol, bdf_formula formula)
      : base(std::move(f), t0, x0, tol), formulas_(formula), weakly_damped_(this->rates()) {
    slope_ = change_ = correction_ = predicted_ = history_ = this->no_rate();
  }

  /// f at the present time and state.
  const rate& slope_now() {
    if (!slope_is_known_) this->evaluate(this->time_, this->x_, slope_);
    slope_is_known_ = true;
    return slope_;
  }
  /// A history of the present state and slope only, with step h and order 1.
  void begin_history(const S& h) {
    differences_.start(this->x_, h * slope_now());
    h_ = h;
    order_ = 1;
    equal_steps_ = 0;
  }
  /// Sets another step length, unless it differs by less than 1/100 due to the rounding of times.
  void change_step(const S& h) {
    using std::abs;
    const S difference = abs(S(h - h_));
    const bool rounding = difference <= 8 * std::numeric_limits<S>::epsilon() * abs(this->time_);
    if (rounding && difference <= S(0.01) * abs(h_)) return;
    differences_.rescale(order_, S(h / h_));
    h_ = h;
    equal_steps_ = 0;
  }
  /// J at the present state.
  void renew_jacobian() {
    this->differentiate(slope_now());
    oscillation_ = weakly_damped_.fastest(this->jacobian_);
    jacobian_is_known_ = jacobian_is_new_ = true;
    matrix_is_known_ = false;
  }

  /// Solves (1) for the time `end`; the solution is in `next_`. Returns whether this was possible; otherwise
  /// `obstacle_` says why.
  bool solve_formula(const S& end) {
    using std::abs;
    if (!jacobian_is_known_) renew_jacobian();
    if (!factorize_for(S(h_ * formulas_.slope(order_)))) return false;
    differences_.predict(order_, predicted_);
    differences_.combine(
        order_, [&](int j) { return formulas_.history(order_, j); }, history_);
    correction_.setZero();
    this->move_to(predicted_);
    this->settle_at(end);
    const S rounding = size(std::numeric_limits<S>::epsilon() * this->x_) + abs(c_) * floor_.size();
    newton_.begin(S(0.05), rounding);  // a small part of the permitted error
    auto progress = detail::newton::go_on;
    while (progress == detail::newton::go_on) {
      this->project();
      this->evaluate(end, this->next_, change_);
      change_ = c_ * change_ - history_ - correction_;
      this->solve(change_);
      correction_ += change_;
      this->move_to(predicted_ + correction_);
      progress = newton_.judge(size(change_));
    }
    if (progress == detail::newton::hopeless)
      obstacle_ = this->next_is_finite() ? detail::diverging : detail::not_finite;
    if constexpr (base::settles)
      if (progress == detail::newton::converged) settle_solution();
    return progress == detail::newton::converged;
  }
  /// The factor on the tolerances for the error of a try. W^-1 maps the rounding error of f to that of the solution.
  S level_of_rounding(const S& error) {
    if (error <= S(1) && floor_.is_below()) return S(1);
    const auto norm = [&](const auto& r) {
      change_ = r;
      this->solve(change_);
      return size(change_);
    };
    const S reach = h_ * formulas_.error(order_) * S(detail::rounding_of_difference(order_));
    return base::level_of_rounding(
        floor_, error, reach, [&] { return norm(differences_[1] / h_); },
        [&](int i, int j) { return norm(this->rounding_of_rate(i, j, slope_now())); });
  }
  /// The longest step of order q at which weakly damped oscillations do not grow.
  S stable_step(int q) const {
    return oscillation_ == S(0) ? std::numeric_limits<S>::infinity()
                                : S(detail::bdf_coefficients<S>::stable_angle(q) / oscillation_);
  }
  /// The error of the step that has been solved.
  S error() const { return size(formulas_.error(order_) * correction_); }
  /// The error of the step that ends with `next_` if it had order q, the present order or a neighbour.
  S error(int q) const { return size(formulas_.error(q) * differences_[q + 1]); }
  /// Adds the state `next_` to the history.
  void extend_history() {
    differences_.add(order_, correction_);
    if constexpr (base::settles) {
      differences_.replace(this->next_);  // without rounding errors
    } else {
      this->next_ = differences_[0];
    }
    ++equal_steps_;
    slope_is_known_ = jacobian_is_new_ = false;
  }

  detail::backward_differences<S, X::RowsAtCompileTime> differences_;  ///< of the states until now, with spacing h
  rate slope_, change_;                                                ///< f at the present state, if known; D of (1)
  S h_{0};                                                             ///< with its sign
  int order_ = 1;
  int equal_steps_ = 0;        ///< number of steps with this order and length
  detail::obstacle obstacle_;  ///< why (1) could not be solved
  bool slope_is_known_ = false, jacobian_is_known_ = false;
  bool jacobian_is_new_ = false;  ///< whether J is that of the present state

 private:
  /// Projects the solution onto the constraints; d goes with it, so that the history is on them.
  void settle_solution() {
    this->settle_next();
    this->check_end();
    correction_ = this->next_ - predicted_;
  }
  bool factorize_for(const S& c) {
    if (matrix_is_known_ && c == c_) return true;
    newton_.forget();
    c_ = c;
    matrix_is_known_ = this->factorize(c);
    if (!matrix_is_known_) obstacle_ = detail::singular;
    return matrix_is_known_;
  }
  /// The norm of an error of the step to `next_`, times ten: errors of steps accumulate, and the final error should be
  /// about the tolerance (tests/integrators/bdf_problems_test.cpp).
  template <class E>
  S size(const E& e) const {
    return 10 * detail::error_norm(this->tolerances_, this->tangential(e), this->x_, this->next_);
  }

  detail::bdf_coefficients<S> formulas_;
  detail::weakly_damped_for<base::size> weakly_damped_;
  detail::newton_progress<S> newton_;
  detail::rounding_floor<S> floor_;
  rate correction_, predicted_, history_;  ///< d, p and the sum of (1)
  S oscillation_{0};                       ///< the fastest weakly damped oscillation of J, rad/s
  S c_{0};                                 ///< c of the factorized matrix
  bool matrix_is_known_ = false;
};

}  // namespace kte
