#pragma once

#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/detail/implicit_stages.hpp>
#include <kte/integrators/tableau.hpp>

#include <array>

namespace kte {

/// The coefficients of an ESDIRK method of N stages: `gamma`, `c`, `a` and the weights `e` of the error, (1) and (3) of
/// `esdirk`. The last row of a holds the weights of the solution; its diagonal is 0, gamma, gamma, ...
template <class S, std::size_t N>
struct esdirk_table {
  using row = std::array<S, N>;
  S gamma;
  row c{};
  std::array<row, N> a{};
  row e{};
};

/// A diagonally implicit Runge-Kutta method of s stages for stiff systems, with an explicit first stage and all other
/// diagonal entries equal; the last stage is at the end of the step, and its slope is the first one of the next:
///
///   k_i = f(t + c_i h, x + d_i),   d_i = h sum_{j<=i} a_ij k_j,   a_ii = gamma, a_11 = 0                 (1)
///   x1 = x + d_s                                                                                         (2)
///
/// The stages are solved as in `implicit_stages`. The error of a step is (3) if the tableau has weights for it,
/// otherwise (4), from the last two steps:
///
///   e = h sum_i e_i k_i                                                                                  (3)
///   e = C h^3 x''',   x''' = 2 (x''_n - x''_{n-1}) / (h_n + h_{n-1}),   x''_n = (k_s - k_1) / h_n        (4)
///
/// or W^-1 e, the effect of the error of stiff components on the solution. At a start, which has no previous step,
/// x''_{n-1} is J f + df/dt with h_{n-1} = 0. Dense output: the cubic through both states and slopes, `hermite_cubic`.
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.6 and IV.8; Hosea and Shampine, Analysis and
/// implementation of TR-BDF2, Appl. Numer. Math. 20 (1996).
///
/// A `Tableau` has `stages`, `order_of_error` (of e in h), table<S>(), `newton_tolerance` (the part of the tolerances
/// that Newton's iterations may leave), `filter_error` (for W^-1 e), and for (4) `error_constant` (C).
template <class Tableau, class F, class X>
class esdirk : public implicit_stages<esdirk<Tableau, F, X>, F, X> {
  using base = implicit_stages<esdirk, F, X>;
  friend integrator<esdirk, F, X>;
  static constexpr std::size_t stages = Tableau::stages;
  static constexpr bool error_from_history = requires { Tableau::error_constant; };

 public:
  using typename base::rate;
  using typename base::S;

  /// f(t, x), start time, s, start state, tolerances. Throws `bad_argument` for invalid tolerances, and for a start
  /// that is not finite.
  esdirk(F f, const S& t0, const std::type_identity_t<X>& x0, const tolerances<S>& tol = {})
      : base(std::move(f), t0, x0, tol, detail::coefficient<S, Tableau::newton_tolerance>()) {
    slope_ = bend_ = sum_ = this->no_rate();
    k_.fill(slope_);
  }

 private:
  void start(const S& t_end) {
    steps_.start(this->tolerances_, this->rates());
    this->evaluate(this->time_, this->x_, this->stage_slope_);
    if (goes_on(t_end)) return;
    slope_.swap(this->stage_slope_);
    this->check_finite_slope(slope_);
    this->forget_jacobian();
    last_h_ = S(0);
    if (this->is_new_) this->choose_first_step(steps_, t_end, slope_, sum_);
  }
  /// Whether the solution continues from the last step: the direction of time is the same, and `slope_` is f at the
  /// present state, which becomes `stage_slope_`, up to the remainder of Newton's iterations as seen through W^-1.
  bool goes_on(const S& t_end) {
    if (this->previous_time_ == this->time_ || (t_end < this->time_) != (last_h_ < S(0))) return false;
    sum_ = last_h_ * (this->stage_slope_ - slope_);
    this->solve(sum_);
    return this->size(sum_) <= S(0.1);
  }

  void advance(const S& t_end) {
    k_[0] = slope_;
    this->take_step(
        steps_, t_end, slope_, [] {}, [&](const S& end) { return try_step(end); });
    if (this->is_explicit()) k_.back() = this->last_slope(), this->stage_slope_ = this->slope_at_end();
    this->keep_jacobian();
    last_h_ = this->time_ - this->previous_time_;
    slope_.swap(this->stage_slope_);
    know_slope_before(bend_);
    bend_ = (slope_ - bend_) / last_h_;
  }
  /// The slope at the start of the last step, as the rate of a displacement from its end.
  void know_slope_before(rate& k) {
    k = k_[0];
    if constexpr (base::on_group) {
      sum_ = -this->displacement();
      this->system().pull_back(sum_, k);
    }
  }

  /// (1) to (4) for the step to `end`.
  detail::attempt<S> try_step(const S& end) {
    const S h = end - this->time_, none = std::numeric_limits<S>::quiet_NaN();
    if (!this->jacobian_is_known()) renew_jacobian(h);
    detail::obstacle obstacle = solve_stages(h, end);
    if (obstacle && !this->jacobian_is_new()) {
      renew_jacobian(h);
      obstacle = solve_stages(h, end);
    }
    if (obstacle) return {none, obstacle};
    this->displace(this->d_);  // (2)
    if (!this->next_is_finite()) return {none};
    this->settle_at(end);
    this->settle_next();
    this->check_end();
    estimate_error(h);
    return {detail::error_norm(this->tolerances_, this->tangential(sum_), this->magnitudes(this->x_),
                               this->magnitudes(this->next_))};
  }
  void renew_jacobian(const S& h) {
    if (last_h_ == S(0)) {
      base::renew_jacobian(slope_);
      if constexpr (error_from_history) {
        this->differentiate_in_time(slope_, h, bend_);
        bend_ += this->jacobian_ * slope_;
      }
    } else {
      this->evaluate(this->time_, this->x_, sum_);
      base::renew_jacobian(sum_);
    }
  }
  detail::obstacle solve_stages(const S& h, const S& end) {
    const S c = table_.gamma * h;
    detail::obstacle obstacle = this->prepare_stages(c);
    for (std::size_t i = 1; i < stages && !obstacle; ++i) {
      combine(table_.a[i], i);
      guess_slope(i, h);
      const S t = table_.c[i] == S(1) ? end : S(this->time_ + table_.c[i] * h);
      obstacle = this->solve_stage(t, c, sum_ *= h, k_[i]);
    }
    return obstacle;
  }
  /// Predicts slopes by extrapolating the last ones.
  void guess_slope(std::size_t i, const S& h) {
    k_[i] = k_[0];
    if (i > 1) {
      k_[i] += (table_.c[i] / table_.c[i - 1]) * (k_[i - 1] - k_[0]);
    } else if (last_h_ != S(0)) {
      k_[i] += (table_.c[i] * h) * bend_;
    }
  }
  /// sum_ = e, or W^-1 e
  void estimate_error(const S& h) {
    if constexpr (error_from_history) {
      const S factor = 2 * detail::coefficient<S, Tableau::error_constant>() * h * h / (h + last_h_);
      sum_ = factor * (k_.back() - k_.front() - h * bend_);  // (4)
    } else {
      combine(table_.e, stages);
      sum_ *= h;  // (3)
    }
    if constexpr (Tableau::filter_error) this->solve(sum_);
  }
  /// sum_ = sum_{i < n} w_i k_i
  void combine(const std::array<S, stages>& w, std::size_t n) {
    sum_.setZero();
    for (std::size_t i = 0; i < n; ++i)
      if (w[i] != S(0)) sum_ += w[i] * k_[i];
  }

  static constexpr int degree() { return 3; }
  void dense(const S& theta, X& x) const {
    this->displaced(detail::hermite_cubic(theta, S(this->time_ - this->previous_time_), this->displacement(),
                                          k_.front(), k_.back()),
                    x);
  }

  decltype(Tableau::template table<S>()) table_ = Tableau::template table<S>();
  detail::step_choice<S> steps_{Tableau::order_of_error, S(1.2)};
  std::array<rate, stages> k_;
  rate slope_;   ///< at the start of the step, as a rate of the state
  rate bend_;    ///< x''_{n-1} of (4)
  S last_h_{0};  ///< h_{n-1} of (4); 0: none
  rate sum_;
};

}  // namespace kte
