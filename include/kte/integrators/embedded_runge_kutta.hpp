#pragma once

#include <kte/integrators/detail/continuous_extension.hpp>
#include <kte/integrators/detail/erased_system.hpp>
#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/detail/step_choice.hpp>
#include <kte/integrators/integrator.hpp>
#include <kte/integrators/tableau.hpp>

namespace kte {

/// An explicit Runge-Kutta method of s stages with an embedded solution, which estimates the error for step control:
///
///   k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j)           (1)
///   x1 = x + h sum_j a_sj k_j                              (2)
///   e = h sum_i (a_si - b_i) k_i                           (3)
///
/// The last row of a contains the weights of the solution, so that the last stage is the slope at the end of the step
/// and the first stage of the next (first same as last). A method without this property gets an additional stage with
/// its weights. Dense output: the cubic through both states and slopes, of order 3, plus the quartic of the tableau, or
/// its extension (`continuous_extension`), if any:
///
///   x(t + theta h) = (1 - theta) x + theta x1
///     + theta (theta - 1) [(1 - 2 theta)(x1 - x) + (theta - 1) h k_1 + theta h k_s]
///     + theta^2 (1 - theta)^2 h (sum_i d_i k_i, or p(theta))      (4)
///
/// (3) is compared with the tolerances, or with the rounding error if that is larger (`rounding_floor`).
///
/// In packs, all lanes have the steps of the lane with the largest error: each lane is within the tolerances, and its
/// digits beyond them depend on the other lanes.
///
/// A `Tableau` has `stages`, `order_of_error` (of e in h), `c`, `a`, `embedded` (b_i), and may have `dense` (d_i) or
/// `extension`.
template <class Tableau, class F, class X>
class embedded_runge_kutta : public integrator<embedded_runge_kutta<Tableau, F, X>, F, X> {
  using base = integrator<embedded_runge_kutta, F, X>;
  friend base;
  using extension = detail::continuous_extension<Tableau, typename base::rate>;
  static constexpr std::size_t stages = Tableau::stages;
  static constexpr double share_of_rounding = [] {
    double sum = 0;
    for (std::size_t i = 0; i < stages; ++i) {
      const ratio b = Tableau::a.back()[i], other = Tableau::embedded[i];
      const double d = static_cast<double>(b.num) / static_cast<double>(b.den) -
                       static_cast<double>(other.num) / static_cast<double>(other.den);
      sum += d < 0 ? -d : d;
    }
    return sum;
  }();

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr bool integrates_packs = true;  ///< many states at once, in lanes

  /// f(t, x), start time, s, start state, tolerances. Throws `bad_argument` for invalid tolerances, and for a start
  /// that is not finite.
  embedded_runge_kutta(F f, const S& t0, const std::type_identity_t<X>& x0, const tolerances<S>& tol = {});
  /// The tolerances.
  [[nodiscard]] const tolerances<S>& bounds() const { return tolerances_; }
  /// The order of the error estimate in the length of a step.
  static constexpr int order_of_error() { return Tableau::order_of_error; }
  /// sum_i |a_si - b_i|: the error of (3) if each slope has an error of less than 1 / h.
  static constexpr double share_of_rounding_errors() { return share_of_rounding; }

 private:
  void start(const S& t_end) {
    steps_.start(tolerances_, this->rates());
    this->evaluate(this->time_, this->x_, slope_at_end());
    if (this->is_new_) choose_first_step(t_end);
  }

  void advance(const S& t_end) {
    begin_step();
    extension_.forget();
    this->previous_time_ = this->time_;  // the stages of the last step are invalid
    this->accept(steps_.take(
        this->time_, t_end, tolerances_, [&]() -> const auto& { return this->magnitudes(this->x_); },
        this->statistics_.rejected, [&](const S& end) { return this->attempted([&] { return try_step(end); }); },
        this->failing()));
  }

  /// The last slope becomes the first one.
  void begin_step() {
    if constexpr (base::on_group) {
      k_.front() = slope_at_end_;
    } else {
      k_.front().swap(k_[stages - 1]);
    }
  }
  rate& slope_at_end() {
    if constexpr (base::on_group) {
      return slope_at_end_;
    } else {
      return k_[stages - 1];
    }
  }

  /// (1) to (3) for the step to `end`.
  detail::attempt<S> try_step(const S& end) {
    const S h = end - this->time_;
    this->settle_at(end);
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(h, end), ...); }
    (std::make_index_sequence<stages - 1>{});
    if (!this->next_is_finite()) return {std::numeric_limits<S>::quiet_NaN()};
    this->check_end();
    const auto& e = this->tangential(h * detail::difference<Tableau::a.back(), Tableau::embedded>(k_));  // (3)
    const S error = detail::error_norm(tolerances_, e, this->magnitudes(this->x_), this->magnitudes(this->next_));
    if (error <= S(1) && floor_.is_below()) [[likely]]
      return {error};
    const auto& sizes = this->magnitudes(this->x_);
    const auto norm = [&](const auto& r) { return detail::error_norm(tolerances_, r, sizes, sizes); };
    const S level = this->level_of_rounding(
        floor_, error, h * S(share_of_rounding), [&] { return norm(k_.front()); },
        [&](int i, int j) { return norm(this->rounding_of_rate(i, j, k_.front())); });
    return {error / level};
  }
  template <std::size_t I>
  void stage(const S& h, const S& end) {
    this->displace(h * detail::combination<Tableau::a[I]>(k_));  // (1); at last (2)
    if constexpr (I + 1 == stages) this->settle_next();
    this->evaluate(detail::stage_time<S, Tableau::c[I]>(this->time_, h, end), this->next_, k_[I]);
    if constexpr (base::on_group && I + 1 == stages)
      slope_at_end_ = k_[I];  // as a displacement from the next state sees it
    this->pull_back(k_[I]);
  }

  static constexpr int degree() {
    if constexpr (extension::stages != 0) {
      return 3 + static_cast<int>(Tableau::extension::dense.size());
    } else {
      return requires { Tableau::dense; }
      ? 4 : 3;
    }
  }
  void dense(const S& theta, X& x) const {
    const S h = this->time_ - this->previous_time_;
    const auto& d = this->displacement();
    const auto cubic = detail::hermite_cubic(theta, h, d, k_.front(), k_[stages - 1]);  // (4)
    const S rt = (S(1) - theta) * theta, weight = rt * rt * h;
    if constexpr (extension::stages != 0) {
      const auto slope = [&](const S& t, const auto& at, rate& k) { this->slope_within(t, at, k); };
      bool made = false;
      if (!this->computes([&] { made = extension_.make(this->previous_time_, h, k_, slope); }, this->next_) || !made)
          [[unlikely]]
        this->fail("the right-hand side is not a finite number between the ends of the last step",
                   failure_reason::not_finite);
      this->displaced(cubic + extension_.polynomial(theta, weight), x);
    } else if constexpr (requires { Tableau::dense; }) {
      this->displaced(cubic + weight * detail::combination<Tableau::dense>(k_), x);
    } else {
      this->displaced(cubic, x);
    }
  }

  void choose_first_step(const S& t_end) {
    const rate& f0 = slope_at_end();
    this->check_finite_slope(f0);  // checks before the state is displaced
    const auto slope_after = [&](const S& h) -> const rate& {
      this->displace(h * f0);
      this->evaluate_if_possible(S(this->time_ + h), this->next_, k_.front());
      this->pull_back(k_.front());
      return k_.front();
    };
    steps_.choose_first(this->time_, t_end, tolerances_, f0, this->magnitudes(this->x_), slope_after, this->failing());
  }

  tolerances<S> tolerances_;
  detail::step_choice<S> steps_{Tableau::order_of_error};
  detail::rounding_floor<S> floor_;
  mutable std::array<rate, stages + extension::stages> k_;  ///< those of the extension only on request
  [[no_unique_address]] mutable extension extension_;
  [[no_unique_address]] typename base::template if_on_group<rate> slope_at_end_;
};

template <class Tableau, class F, class X>
embedded_runge_kutta<Tableau, F, X>::embedded_runge_kutta(F f, const S& t0, const std::type_identity_t<X>& x0,
                                                          const tolerances<S>& tol)
    : base(std::move(f), t0, x0), tolerances_(tol), extension_(this->no_rate()) {
  tol.check(this->rates());
  k_.fill(this->no_rate());
}

}  // namespace kte
