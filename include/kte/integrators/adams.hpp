#pragma once

#include <kte/integrators/detail/adams_differences.hpp>
#include <kte/integrators/detail/adams_errors.hpp>
#include <kte/integrators/detail/error_weights.hpp>
#include <kte/integrators/detail/step_choice.hpp>
#include <kte/integrators/integrator.hpp>

namespace kte {

/// Adams method with variable step and order: a predictor of order k, 1 to 12, from the k newest slopes, and a
/// corrector of order k + 1 (local extrapolation), two evaluations a step:
///
///   p = x + h sum_{j<k} g_j beta_j phi_j                   (1)
///   e_k = f(t + h, p) - sum_{j<k} beta_j phi_j             (2)
///   x1 = p + h g_k e_k                                     (3)
///   error = h (g_k - g_{k-1}) e_k                          (4)
///
/// from the history of slopes, see `adams_differences`. (4) is the difference to the corrector of order k. The errors
/// of orders k - 1 and k + 1 follow from e_{k-1} = e_k + beta_{k-1} phi_{k-1}; the order with the longest next step is
/// taken. (4) is compared with the tolerances, or with the rounding error where that is larger (`rounding_floor`).
/// Between the ends of a step, the integral of the polynomial through its k + 1 slopes has order k + 1. A cubic removes
/// the jump that the last evaluation leaves at the end, so that state and slope are continuous:
///
///   x(t + theta h) = x + int P - theta^2 (3 - 2 theta) h g_k (f(t + h, x1) - f(t + h, p))             (5)
///
/// If states are kept on constraints (models/vector_form.hpp), the end of a step and interpolated states are projected
/// onto them. The history then consists of slopes on the constraints, and errors are compared without their part normal
/// to them.
///
/// For smooth, expensive right-hand sides and for tight tolerances: few evaluations, but more overhead than one-step
/// methods. `integrate` continues with the history of the previous call if time, direction and slope are unchanged.
/// Otherwise, and after `restart`, it starts again with order 1. Use a one-step method for inputs that jump at every
/// sample.
///
///   kte::adams solver(f, 0.0, x0, {.absolute = 1e-12, .relative = 1e-12});
///   solver.integrate(10.0);
///
/// Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, III.5 and III.7; Shampine and Gordon,
/// Computer Solution of Ordinary Differential Equations, 1975; (5): Watts and Shampine, Smoother interpolants for Adams
/// codes, SIAM J. Sci. Stat. Comput. 7 (1986).
template <class F, class X>
class adams : public integrator<adams<F, X>, F, X> {
  using base = integrator<adams, F, X>;
  friend base;
  static_assert(!base::on_group,
                "kte: this method keeps a history of slopes, which needs states that are vectors: use a one-step "
                "method, such as dormand_prince45 or prince_dormand87, or kte::vector_form(model)");

 public:
  using typename base::S;
  /// The highest order of the predictor.
  static constexpr int max_order = 12;

  /// f(t, x), start time, s, start state, tolerances. Throws `bad_argument` for invalid tolerances, and for a start
  /// that is not finite.
  adams(F f, const S& t0, const std::type_identity_t<X>& x0, const tolerances<S>& tol = {})
      : base(std::move(f), t0, x0), weights_(checked(tol), this->rates()), past_(this->no_rate()) {
    slope_ = predicted_ = change_ = this->no_rate();
  }

  /// The tolerances.
  [[nodiscard]] const tolerances<S>& bounds() const { return weights_.of(); }
  /// The order k of the predictor of the next step.
  [[nodiscard]] int order() const { return order_; }

 private:
  const tolerances<S>& checked(const tolerances<S>& tol) const {
    tol.check(this->rates());
    return tol;
  }
  void start(const S& t_end) {
    steps_.start(weights_.of(), this->rates());
    const bool forward = this->time_ < t_end, restarted = this->previous_time_ == this->time_;
    this->evaluate(this->time_, this->x_, slope_);
    if (!restarted && forward == forward_ && slope_ == past_.newest()) return;
    forward_ = forward;
    const auto slope_after = [&](const S& h) -> const X& {
      this->displace(h * slope_);
      this->evaluate_if_possible(S(this->time_ + h), this->next_, change_);
      return change_;
    };
    steps_.choose_first(this->time_, t_end, weights_.of(), slope_, this->x_, slope_after, this->failing());
    past_.start(this->time_, slope_);
    order_ = 1;
    this->previous_time_ = this->time_;  // the polynomial of the last step is invalid
  }

  void advance(const S& t_end) {
    this->previous_time_ = this->time_;  // the polynomial of the last step becomes invalid
    failures_ = 0;
    this->accept(steps_.take(
        this->time_, t_end, weights_.of(), [&]() -> const auto& { return this->magnitudes(this->x_); },
        this->statistics_.rejected, [&](const S& end) { return this->attempted([&] { return try_step(end); }); },
        this->failing()));
  }
  detail::attempt<S> try_step(const S& end) {
    using std::abs;
    detail::adams_errors<S> e = predict(end);
    const S length = abs(h_);
    const S level = e.same <= S(1) && floor_.is_below() ? S(1) : square_of_level(e.same);
    const bool accepted = e.same <= level && correct(end, e);
    if (level != S(1)) [[unlikely]]
      e.compare_with(level);
    if (accepted) {
      interpolated_ = order_ + 1;
      return {.error = e.same, .next = e.next_step(length, steps_.proposed(), order_)};
    }
    const S next = e.shorter_step(length, order_);
    if (++failures_ == 3) past_.forget(), order_ = 1;  // the history is useless here
    return {.error = e.same, .next = next};
  }

  /// (1), (2), (4).
  detail::adams_errors<S> predict(const S& end) {
    h_ = end - this->time_;
    past_.aim(end, order_);
    this->move_to(this->x_ + h_ * past_.mean());
    this->evaluate(end, this->next_, predicted_);
    change_ = predicted_ - past_.slope();
    weights_.weigh(this->x_, this->next_);
    detail::adams_errors<S> e{square(order_, change_)};
    const int lower = order_ - 1;
    if (lower > 0) e.lower = square(lower, change_ + past_.beta(lower) * past_.difference(lower));
    return e;
  }
  /// (2) is a k-th difference of slopes that are rounded independently.
  [[gnu::noinline]] S square_of_level(const S& error) {
    using std::sqrt;
    const auto norm = [&](const auto& r) { return S(sqrt(weights_.square(r, this->x_, this->next_))); };
    const S reach = h_ * (past_.g(order_) - past_.g(order_ - 1)) * S(detail::rounding_of_difference(order_));
    const S level = this->level_of_rounding(
        floor_, sqrt(error), reach, [&] { return norm(past_.newest()); },
        [&](int i, int j) { return norm(this->rounding_of_rate(i, j, past_.newest())); });
    return level * level;
  }
  /// (3), projected onto constraints, and the slope there, which is added to the history. Returns false if the error is
  /// not finite.
  bool correct(const S& end, detail::adams_errors<S>& e) {
    by_ = h_ * past_.g(order_);
    this->next_ += by_ * change_;
    this->settle_at(end);
    if constexpr (base::settles)
      if (this->next_is_finite()) this->settle_next();
    this->evaluate(end, this->next_, slope_);
    past_.offer(slope_);
    if (this->next_is_finite()) this->check_end();
    if (!this->next_is_finite() || !detail::all_finite(slope_)) {
      e.same = std::numeric_limits<S>::quiet_NaN();
      return false;
    }
    if (order_ < past_.known() && order_ < max_order)
      e.higher = square(order_ + 1, slope_ - past_.slope() - past_.beta(order_) * past_.difference(order_));
    past_.append(end);
    return true;
  }
  /// The square of the norm of (4).
  template <class E>
  S square(int k, const E& e) const {
    const S factor = h_ * (past_.g(k) - past_.g(k - 1));
    return factor * factor * weights_.square(this->tangential(e), this->x_, this->next_);
  }

  int degree() const { return interpolated_ < 3 ? 3 : interpolated_; }
  void dense(const S& theta, X& x) const {
    const S s = theta * h_;
    past_.interpolate(s, interpolated_, x);
    x = this->previous_ + s * x - (theta * theta * (3 - 2 * theta) * by_) * (slope_ - predicted_);  // (5)
    this->settle_within(x);
  }

  detail::error_weights<X> weights_;
  detail::step_choice<S> steps_{2};
  detail::rounding_floor<S> floor_;
  detail::adams_differences<X> past_;
  X slope_, predicted_, change_;  ///< at the end of the step; at p; (2)
  S h_{}, by_{};                  ///< of the step being tried, or of the last step: its length, and h g_k
  int order_ = 1;                 ///< k
  int interpolated_ = 1;          ///< number of slopes of the polynomial of the last step
  int failures_ = 0;              ///< of the current step
  bool forward_ = true;
};

template <class F, class V>
adams(F, const typename V::Scalar&, const Eigen::MatrixBase<V>&,
      const tolerances<detail::time_scalar<typename V::Scalar>>& = {}) -> adams<F, typename V::PlainObject>;

}  // namespace kte
