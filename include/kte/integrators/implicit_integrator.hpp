#pragma once

#include <kte/integrators/detail/step_choice.hpp>
#include <kte/integrators/integrator.hpp>

#include <Eigen/LU>

namespace kte {

/// Base of methods for stiff systems: the Jacobian of the right-hand side, and linear systems with it.
///
///   J_ij = d f_i / d x_j,   W = I - c J                (1)
///
/// J is f.jacobian(t, x, J) if f has it, as models do: f fills a square matrix J of the right size, and may return
/// false if it cannot. Otherwise J is computed by differences (f(x + d_j) - f(x)) / d_j, with one evaluation per column
/// and d_j = sqrt(eps) max(|x_j|, absolute_j / relative_j), or sqrt(eps) if that is 0. For states with rotations, J is
/// the derivative of the rate of the displacement by the displacement, at 0. If states are kept on constraints, f is
/// evaluated on them only: J, by differences, and the stages are those of f at the projected state.
template <class Method, class F, class X>
class implicit_integrator : public integrator<Method, F, X> {
  using base = integrator<Method, F, X>;

 public:
  using typename base::rate;
  using typename base::S;

  /// The tolerances.
  [[nodiscard]] const tolerances<S>& bounds() const { return tolerances_; }

 protected:
  static constexpr int size = rate::RowsAtCompileTime;
  using matrix = Eigen::Matrix<S, size, size>;

  implicit_integrator(F f, const S& t0, const X& x0, const tolerances<S>& tol)
      : base(std::move(f), t0, x0),
        tolerances_(tol),
        jacobian_(matrix::Zero(this->rates(), this->rates())),
        matrix_(jacobian_),
        shifted_(this->no_rate()),
        probe_(shifted_) {
    tol.check(this->rates());
  }

  /// Chooses the first step towards t_end by an Euler step with `slope`; stores the slope after it in `trial`.
  void choose_first_step(detail::step_choice<S>& steps, const S& t_end, const rate& slope, rate& trial) {
    this->check_finite_slope(slope);  // checks before the state is displaced
    const auto slope_after = [&](const S& h) -> const rate& {
      this->displace(h * slope);
      this->evaluate_if_possible(S(this->time_ + h), this->next_, trial);
      this->pull_back(trial);
      return trial;
    };
    steps.choose_first(this->time_, t_end, tolerances_, slope, this->magnitudes(this->x_), slope_after,
                       this->failing());
  }
  /// Tries steps towards t_end until one is accepted. try_step(end): a `detail::attempt`, with its state in `next_`; it
  /// uses `attempted`.
  template <class Try>
  void take_step(detail::step_choice<S>& steps, const S& t_end, const Try& try_step) {
    this->previous_time_ = this->time_;  // the stages of the last step are invalid
    this->accept(steps.take(
        this->time_, t_end, tolerances_, [&]() -> const auto& { return this->magnitudes(this->x_); },
        this->statistics_.rejected, try_step, this->failing()));
  }
  /// next_ = state (+) d, and then projected onto constraints, for evaluations of f. Off the constraints, f may change
  /// by 1 / distance from a singular configuration; W would make that a restriction of the step.
  template <class D>
  void displace_on_constraints(const S& t, const D& d) {
    this->displace(d);
    this->settle_at(t);
    project();
  }
  void project() {
    if constexpr (base::settles)
      if (this->next_is_finite()) this->settle_next();
  }
  /// Computes J at the present time and state, where f is `slope`. Overwrites `next_`.
  void differentiate(const rate& slope) {
    ++this->statistics_.jacobians;
    if (!take_jacobian()) {
      using std::abs;
      const auto& sizes = this->magnitudes(this->x_);
      rate& d = probe_;
      d.setZero();
      for (Eigen::Index j = 0; j < this->rates(); ++j) {
        const S x = abs(sizes[j]), least = least_size(j);
        d[j] = root_of_epsilon() * (x < least ? least : x == S(0) ? S(1) : x);
        displace_on_constraints(this->time_, d);
        this->slope(this->time_, shifted_);
        jacobian_.col(j) = (shifted_ - slope) / d[j];
        d[j] = S(0);
      }
    }
    check_finite(jacobian_);
  }
  /// Computes df/dt at the present time and state, where f is `slope`: f.time_derivative(t, x, out), or a difference. f
  /// may change within a step h, and t is rounded, so a difference to the time t + d has a relative error of about
  ///
  ///   sqrt(eps (h + |t|) / h),   d = sqrt(eps h (h + |t|))                                             (2)
  ///
  /// If this error times h^2 df/dt matters to the tolerances, judged by the previous df/dt in `out`, one more
  /// evaluation is made: the difference from t - d to t + d, d = cbrt(eps) sqrt(h (h + |t|)). It is not made if t - d
  /// is before the last step, because f may differ before a start or an event. Overwrites `next_`.
  void differentiate_in_time(const rate& slope, const S& h, rate& out) {
    if constexpr (requires { this->system().time_derivative(this->time_, this->x_, out); }) {
      this->ask([&] { this->system().time_derivative(this->time_, this->x_, out); });
    } else {
      using std::abs;
      using std::cbrt;
      using std::sqrt;
      const S eps = std::numeric_limits<S>::epsilon(), length = abs(h), reach = length + abs(this->time_);
      const S mean = sqrt(length * reach), part = root_of_epsilon() * mean / length;
      const auto& sizes = this->magnitudes(this->x_);
      const S signed_mean = h < S(0) ? S(-mean) : mean, wide = S(cbrt(eps)) * signed_mean;
      const bool both = this->in_last_step(S(this->time_ - wide)) &&
                        detail::error_norm(tolerances_, (h * h * part) * out, sizes, sizes) > S(0.1);
      const S d = both ? wide : S(root_of_epsilon() * signed_mean);
      const S after = this->time_ + d, before = both ? S(this->time_ - d) : this->time_;
      if (after == before) [[unlikely]] {  // h^2 underflows to 0
        out.setZero();
        return;
      }
      this->evaluate_if_possible(after, this->x_, shifted_);
      if (both) this->evaluate_if_possible(before, this->x_, out);
      out = (shifted_ - (both ? out : slope)) / S(after - before);
    }
  }
  /// Factorizes W for `solve`. Returns whether this was possible.
  bool factorize(const S& c) {
    ++this->statistics_.factorizations;
    matrix_ = -c * jacobian_;
    matrix_.diagonal().array() += S(1);
    factors_.compute(matrix_);
    return detail::is_finite(S(factors_.matrixLU().sum())) && (factors_.matrixLU().diagonal().array() != S(0)).all();
  }
  /// b = W^-1 b.
  void solve(rate& b) {
    shifted_ = factors_.solve(b);
    b.swap(shifted_);
  }

  tolerances<S> tolerances_;
  matrix jacobian_;

 private:
  /// The size of component j below which its size does not matter: absolute_j / relative_j. Without a relative
  /// tolerance, the size for which differences equal the absolute tolerance.
  S least_size(Eigen::Index j) const {
    const S &a = tolerances_.absolute[j], &r = tolerances_.relative[j];
    return a / (r == S(0) ? root_of_epsilon() : r);
  }
  /// Computes J by f; returns whether f knows it.
  bool take_jacobian() {
    if constexpr (requires { this->system().jacobian(this->time_, this->x_, jacobian_); }) {
      bool known = true;
      this->ask([&] {
        if constexpr (std::is_same_v<decltype(this->system().jacobian(this->time_, this->x_, jacobian_)), bool>) {
          known = this->system().jacobian(this->time_, this->x_, jacobian_);
        } else {
          this->system().jacobian(this->time_, this->x_, jacobian_);
        }
      });
      return known;
    } else {
      return false;
    }
  }
  static S root_of_epsilon() {
    using std::sqrt;
    return sqrt(std::numeric_limits<S>::epsilon());
  }
  void check_finite(const matrix& m) const {
    if (!detail::all_finite(m)) [[unlikely]]
      this->fail("the Jacobian has a number that is not finite", failure_reason::not_finite);
  }

  matrix matrix_;
  Eigen::PartialPivLU<matrix> factors_{matrix_};
  rate shifted_, probe_;
};

}  // namespace kte
