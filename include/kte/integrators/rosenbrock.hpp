#pragma once

#include <kte/integrators/detail/singular_passage.hpp>

#include <array>

namespace kte {

/// The coefficients of a Rosenbrock method of N stages with a dense output of degree P: `gamma`, `alpha`, `a`, `c`,
/// `m`, `e` and `dense` of (1) to (6) of `rosenbrock`.
template <class S, std::size_t N, std::size_t P>
struct rosenbrock_table {
  using row = std::array<S, N>;
  S gamma;
  row alpha{};   ///< times of stages
  row gammas{};  ///< weights of df/dt
  std::array<row, N> a{}, c{};
  row m{}, e{};
  std::array<row, P> dense{};
};

/// A Rosenbrock method of s stages: for stiff systems, with linear equations only. With J = df/dx and f_t = df/dt, both
/// at the start of the step:
///
///   W = I - gamma h J                                                                                  (1)
///   W u_i = gamma [h f(t + alpha_i h, x + sum_{j<i} a_ij u_j) + sum_{j<i} c_ij u_j + gamma_i h^2 f_t]  (2)
///   x1 = x + sum_i m_i u_i                                                                             (3)
///   e = sum_i e_i u_i                                                                                  (4)
///   x(t + theta h) = x + sum_i p_i(theta) u_i,   p_i a polynomial, p_i(0) = 0                          (5)
///
/// Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, IV.7, (7.24), (7.25). J and f_t are those of
/// `implicit_integrator`: exact if f has them, otherwise by differences. One Jacobian a step, one factorization a try,
/// and s evaluations a step, or s - 1 if the last stage is at x1 (`first_same_as_last`).
///
/// `Coefficients` has `stages`, `order_of_error` (of e in h), `first_same_as_last` and table<S>(). `dense` of the table
/// holds the coefficients of theta, theta^2, ... in p_i.
template <class Coefficients, class F, class X>
class rosenbrock : public singular_passage<rosenbrock<Coefficients, F, X>, F, X> {
  using base = singular_passage<rosenbrock, F, X>;
  friend integrator<rosenbrock, F, X>;
  static constexpr std::size_t stages = Coefficients::stages;

 public:
  using typename base::rate;
  using typename base::S;

  /// f(t, x), start time, s, start state, tolerances. Throws `bad_argument` for invalid tolerances, and for a start
  /// that is not finite.
  rosenbrock(F f, const S& t0, const std::type_identity_t<X>& x0, const tolerances<S>& tol = {})
      : base(std::move(f), t0, x0, tol),
        slope_(this->no_rate()),
        last_slope_(slope_),
        slope_in_time_(slope_),
        sum_(slope_) {
    u_.fill(slope_);
  }

 private:
  void start(const S& t_end) {
    steps_.start(this->tolerances_, this->rates());
    this->evaluate(this->time_, this->x_, slope_);
    slope_is_known_ = true;
    if (this->is_new_) this->choose_first_step(steps_, t_end, slope_, last_slope_);
  }

  void advance(const S& t_end) {
    if (!slope_is_known_) this->evaluate(this->time_, this->x_, slope_);
    slope_is_known_ = true;
    this->check_finite_slope(slope_);
    const auto differentiate = [&] {
      this->differentiate(slope_);
      this->differentiate_in_time(slope_, steps_.proposed(this->time_, t_end), slope_in_time_);
    };
    this->take_step(steps_, t_end, slope_, differentiate, [&](const S& end) { return try_step(end); });
    if (this->is_explicit())
      slope_ = this->slope_at_end();
    else
      slope_.swap(last_slope_);
    slope_is_known_ = Coefficients::first_same_as_last || this->is_explicit();
  }

  /// (1) to (4) for the step to `end`.
  detail::attempt<S> try_step(const S& end) {
    const S h = end - this->time_, none = std::numeric_limits<S>::quiet_NaN();
    if (!this->factorize(table_.gamma * h))
      return {none, {"the matrix I - gamma h J is singular", failure_reason::singular_matrix}};
    for (std::size_t i = 0; i < stages; ++i) stage(i, h, end);
    if constexpr (!Coefficients::first_same_as_last) {
      combine(table_.m);
      this->displace_on_constraints(end, sum_);  // (3)
    }
    if (!this->next_is_finite()) return {none};
    this->check_end();
    combine(table_.e);  // (4)
    return {detail::error_norm(this->tolerances_, this->tangential(sum_), this->magnitudes(this->x_),
                               this->magnitudes(this->next_))};
  }
  /// (2)
  void stage(std::size_t i, const S& h, const S& end) {
    if (i == 0) {
      u_[0] = slope_;
    } else {
      combine(table_.a[i]);
      const S& alpha = table_.alpha[i];
      const S t = alpha == S(1) ? end : S(this->time_ + alpha * h);
      this->displace_on_constraints(t, sum_);  // also (3), if that is the last stage
      this->evaluate(t, this->next_, last_slope_);
      u_[i] = last_slope_;
      this->pull_back(u_[i]);
    }
    combine(table_.c[i]);
    u_[i] = table_.gamma * (h * u_[i] + sum_ + (table_.gammas[i] * h * h) * slope_in_time_);
    this->solve(u_[i]);
  }
  /// sum_ = sum_i w_i u_i
  void combine(const std::array<S, stages>& w) {
    sum_.setZero();
    for (std::size_t i = 0; i < stages; ++i)
      if (w[i] != S(0)) sum_ += w[i] * u_[i];
  }

  int degree() const { return this->is_explicit() ? 3 : static_cast<int>(table_.dense.size()); }
  void dense(const S& theta, X& x) const {
    if (this->is_explicit()) return this->displaced(this->explicit_displacement(theta), x);
    sum_.setZero();
    for (std::size_t i = 0; i < stages; ++i) {
      S p(0);
      for (std::size_t n = table_.dense.size(); n-- > 0;) p = theta * (p + table_.dense[n][i]);
      sum_ += p * u_[i];  // (5)
    }
    this->displaced(sum_, x);
  }

  decltype(Coefficients::template table<S>()) table_ = Coefficients::template table<S>();
  detail::step_choice<S> steps_{Coefficients::order_of_error};
  rate slope_, last_slope_;  ///< at the start of the step, and of the last stage, as rates of the state
  rate slope_in_time_;
  mutable rate sum_;
  std::array<rate, stages> u_;
  bool slope_is_known_ = false;
};

}  // namespace kte
