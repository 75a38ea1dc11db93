#pragma once

#include <kte/integrators/detail/newton_progress.hpp>
#include <kte/integrators/detail/singular_passage.hpp>

namespace kte {

/// Implicit stages solved one after the other, for methods with a constant diagonal. With the displacement d of a stage
/// from the start of the step, and the slope k there:
///
///   d = b + c k,   k = f(t, x + d)                                                                   (1)
///
/// by simplified Newton iterations, until D is below a fraction of the tolerances:
///
///   W D = r,   r = b + c f(t, x + d) - d,   W = I - c J,   d <- d + D                                (2)
///
/// J is kept from step to step until the iterations converge slowly; W is kept while c changes by less than 1/100. The
/// rate of convergence is therefore not below 1/100, even with a new J. The slope at the solution is not evaluated,
/// because stiffness would amplify the error of D:
///
///   k = f + J D = f + (D - r) / c                                                                    (3)
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.8.
template <class Method, class F, class X>
class implicit_stages : public singular_passage<Method, F, X> {
  using base = singular_passage<Method, F, X>;

 public:
  using typename base::rate;
  using typename base::S;

 protected:
  /// newton_tolerance: the fraction of the tolerances that may remain in (2).
  implicit_stages(F f, const S& t0, const X& x0, const tolerances<S>& tol, const S& newton_tolerance)
      : base(std::move(f), t0, x0, tol), newton_tolerance_(newton_tolerance) {
    d_ = stage_slope_ = residual_ = correction_ = this->no_rate();
  }

  bool jacobian_is_known() const { return jacobian_is_known_; }
  /// Whether J is that of the present state.
  bool jacobian_is_new() const { return jacobian_is_new_; }
  /// For a start: discards all data of f.
  void forget_jacobian() { jacobian_is_known_ = jacobian_is_new_ = false; }
  /// After a step: J is that of the previous state.
  void keep_jacobian() { jacobian_is_new_ = false; }
  /// slope: f at the present time and state (not (3), which would make differences wrong).
  void renew_jacobian(const rate& slope) {
    this->differentiate(slope);
    jacobian_is_known_ = jacobian_is_new_ = true;
    matrix_c_ = S(0);
  }

  /// Factorizes W for stages with c. Returns the obstacle, if any.
  detail::obstacle prepare_stages(const S& c) {
    using std::abs;
    if (abs(S(c - matrix_c_)) <= abs(matrix_c_) / 100) return {};
    newton_.forget();
    matrix_c_ = this->factorize(c) ? c : S(0);
    return matrix_c_ == S(0) ? detail::singular : detail::obstacle{};
  }
  /// Solves (1) at the time t, starting from k. Returns the obstacle, if any. The results are k, d_, and the slope as a
  /// rate of the state in `stage_slope_`.
  detail::obstacle solve_stage(const S& t, const S& c, const rate& b, rate& k) {
    d_ = b + c * k;
    newton_.begin(newton_tolerance_, size(std::numeric_limits<S>::epsilon() * this->magnitudes(this->x_)));
    for (bool first = true;; first = false) {
      this->displace_on_constraints(t, d_);
      this->evaluate(t, this->next_, stage_slope_);
      k = stage_slope_;
      this->pull_back(k);
      residual_ = b + c * k - d_;
      correction_ = residual_;
      this->solve(correction_);
      d_ += correction_;
      const S corrected = size(correction_);
      switch (newton_.judge(corrected)) {
        case detail::newton::go_on:
          break;
        case detail::newton::converged:
          if (first && corrected > 100 * newton_tolerance_) break;  // the rate is 1/100 at best
          residual_ = (correction_ - residual_) / c;
          k += residual_;  // (3)
          stage_slope_ += residual_;
          return {};
        case detail::newton::hopeless:
          return detail::is_finite(corrected) ? detail::diverging : detail::not_finite;
      }
    }
  }

  /// The norm of a displacement relative to the tolerances.
  template <class E>
  S size(const E& e) const {
    const auto& sizes = this->magnitudes(this->x_);
    return detail::error_norm(this->tolerances_, e, sizes, sizes);
  }

  rate d_;            ///< of the last stage
  rate stage_slope_;  ///< of the last stage

 private:
  S newton_tolerance_;
  detail::newton_progress<S> newton_;
  rate residual_, correction_;
  S matrix_c_{0};  ///< the c of W; 0 if there is no W
  bool jacobian_is_known_ = false, jacobian_is_new_ = false;
};

}  // namespace kte
