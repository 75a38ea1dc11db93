#pragma once

#include <kte/integrators/detail/bdf_order.hpp>
#include <kte/integrators/detail/bdf_step.hpp>
#include <kte/integrators/detail/step_choice.hpp>

namespace kte {

/// Settings of `bdf`.
struct bdf_settings {
  int max_order = 5;  ///< 1 to 5. Orders 1 and 2 are A-stable; above, weakly damped oscillations limit the step
  bdf_formula formula = bdf_formula::numerical_differentiation;  ///< the family of formulas
};

/// Backward differentiation formulas of orders 1 to 5, or the numerical differentiation formulas, which are more
/// accurate, with variable step and order. For stiff systems.
///
///   kte::bdf solver(f, 0.0, x0, {.absolute = 1e-9, .relative = 1e-9});
///   solver.integrate(10.0);
///   solver.integrate(20.0, kte::every(0.001), [](double t, const auto& x) { ... });
///
/// One to two evaluations of f per step, and occasionally a Jacobian: f.jacobian(t, x, J) or differences
/// (`implicit_integrator`). The step is constant for several steps. When it changes, the history is interpolated to the
/// new step (`backward_differences`). Dense output: the polynomial of the order of the step through the states up to
/// its end.
///
/// The error of one step may be a tenth of the tolerances, so that the accumulated error is about the tolerance. If
/// rounding errors are larger, they replace the tolerances (`rounding_floor`).
///
/// Weakly damped oscillations grow at orders 3 to 5, unless h w is small (`bdf_coefficients::stable_angle`). The
/// eigenvalues of each Jacobian give the frequencies w. If order 2 allows a longer step than the stable steps of higher
/// orders, as for flexible systems whose fast modes are at rest, the order stays at 2.
///
/// If states are kept on constraints (models/vector_form.hpp), the end of a step and interpolated states are projected
/// onto them. The history then consists of states on the constraints, and errors are compared without their part normal
/// to them.
///
/// The history is kept from one `integrate` to the next, unless time, state, direction or the slope f(t, x) has
/// changed. It then starts again with order 1.
///
/// Shampine and Reichelt, The MATLAB ODE Suite, SIAM J. Sci. Comput. 18 (1997), section 2.
template <class F, class X>
class bdf : public bdf_step<bdf<F, X>, F, X> {
  using base = bdf_step<bdf, F, X>;
  friend integrator<bdf, F, X>;
  static_assert(
      !base::on_group,
      "kte: this method keeps a history of states, which needs states that are vectors: use a one-step method "
      "for stiff systems, or kte::vector_form(model)");

 public:
  using typename base::rate;
  using typename base::S;

  /// f(t, x), start time, s, start state, tolerances, settings. Throws `bad_argument` for invalid tolerances, for an
  /// invalid order, and for a start that is not finite.
  bdf(F f, const S& t0, const std::type_identity_t<X>& x0, const tolerances<S>& tol = {},
      const bdf_settings& settings = {})
      : base(std::move(f), t0, x0, tol, settings.formula), max_order_(settings.max_order) {
    constexpr int most = detail::bdf_coefficients<S>::most;
    if (max_order_ < 1 || max_order_ > most)
      detail::raise<bad_argument>("kte: max_order must be 1 to " + std::to_string(most) + ", got " +
                                  std::to_string(max_order_));
  }

  /// The order of the last step.
  [[nodiscard]] int order() const { return order_of_last_; }

 private:
  void start(const S& t_end) {
    steps_.start(this->tolerances_, this->rates());
    this->evaluate(this->time_, this->x_, this->change_);
    if (continues(t_end)) return;
    this->previous_time_ = this->time_;  // no step to interpolate
    this->slope_.swap(this->change_);
    this->slope_is_known_ = true;
    this->jacobian_is_known_ = false;
    this->choose_first_step(steps_, t_end, this->slope_, this->change_);
    this->begin_history(steps_.proposed(this->time_, t_end));
    time_of_history_ = this->time_;
  }
  /// Whether the history is consistent with the present state and the direction to t_end. `change_` becomes the present
  /// slope.
  bool continues(const S& t_end) const {
    return this->slope_is_known_ && (t_end < this->time_) == (this->h_ < S(0)) && this->time_ == time_of_history_ &&
           this->x_ == this->differences_[0] && this->change_ == this->slope_;
  }

  void advance(const S& t_end) {
    time_of_history_ = std::numeric_limits<S>::quiet_NaN();  // undefined until the first step
    this->take_step(steps_, t_end, [&](const S& end) { return this->attempted([&] { return try_step(end); }); });
    time_of_history_ = this->time_;
    if (this->time_ == t_end) this->slope_now();  // the next `start` compares
  }
  /// Stores the new state in `next_`, or proposes a shorter step, or the same step with a new Jacobian.
  detail::attempt<S> try_step(const S& end) {
    using std::abs;
    this->change_step(end - this->time_);
    const S length = abs(this->h_);
    if (!this->solve_formula(end)) {
      const S nan = std::numeric_limits<S>::quiet_NaN();
      if (this->jacobian_is_new_) {
        this->level_of_rounding(S(2));
        return {nan, this->obstacle_, length / 4};
      }
      this->renew_jacobian();
      return {nan, this->obstacle_, length};
    }
    const S seen = this->error(), level = this->level_of_rounding(seen), error = seen / level;
    if (error <= S(1)) {
      this->extend_history();
      order_of_last_ = this->order_;
      return {.error = error, .next = plan(length, level)};
    }
    return {.error = error, .next = length * detail::shrink_step(this->order_, error)};
  }
  /// The length of the next step; sets its order.
  S plan(const S& length, const S& level) {
    if (this->equal_steps_ <= this->order_) {  // D^{k+2} needs k + 1 equal steps
      const S& proposed = steps_.proposed();   // the proposal is longer if this step was cut short
      return proposed < length ? length : 2 * length < proposed ? S(2 * length) : proposed;
    }
    const auto next = detail::choose_order<S>(
        this->order_, max_order_, [&](int q) { return S(this->error(q) / level); },
        [&](int q) { return S(this->stable_step(q) / length); });
    if (this->order_ != next.order) this->equal_steps_ = 0;
    this->order_ = next.order;
    return length * next.factor;
  }
  int degree() const { return order_of_last_; }
  void dense(const S& theta, X& x) const {
    this->differences_.interpolate(order_of_last_, theta, this->previous_, x);
    this->settle_within(x);
  }

  detail::step_choice<S> steps_{2};
  S time_of_history_{0};
  int max_order_, order_of_last_ = 1;
};

template <class F, class V>
bdf(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
    const tolerances<detail::time_scalar<typename V::Scalar>>& = {}, const bdf_settings& = {})
    -> bdf<F, typename V::PlainObject>;

}  // namespace kte
