#pragma once

#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/dormand_prince45.hpp>
#include <kte/integrators/implicit_integrator.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace kte {

/// Base of implicit one-step methods that keep states on constraints. Their stages are projected onto the constraints.
/// At a relative distance d from a singular configuration, f.singular_distance(x), projected positions have errors of
/// eps / d, velocities of eps / d^2 and accelerations of
///
///   eps / d^3          (1)
///
/// Stages of explicit methods are not projected, and their accelerations have errors of eps / d. Therefore, if (1) is
/// above 1/10 of a tolerance, a step is first tried by `dormand_prince45`. If the error of this is too large, as it is
/// in stiff systems, the implicit method tries the same step, and ever more of the next steps alone.
template <class Method, class F, class X>
class singular_passage : public implicit_integrator<Method, F, X> {
  using base = implicit_integrator<Method, F, X>;
  using tableau = dormand_prince45_tableau;

 public:
  using typename base::rate;
  using typename base::S;

 protected:
  using base::base;

  /// `take_step` of the base, with the slope at the start. prepare(): called before the first try of the implicit
  /// method.
  template <class Prepare, class Try>
  void take_step(detail::step_choice<S>& steps, const S& t_end, const rate& slope, const Prepare& prepare,
                 const Try& try_step) {
    if constexpr (base::settles) {
      const bool singular = is_nearly_singular();
      bool prepared = false;
      base::take_step(steps, t_end, [&](const S& end) {
        if (singular && rest_-- <= 0) {
          const auto tried = this->attempted([&] { return try_explicit_step(slope, end); });
          if (tried.error <= S(1)) return rest_ = 0, last_rest_ = 0, is_explicit_ = true, tried;
          rest_ = last_rest_ = (std::min)(2 * last_rest_ + 1, 63);
        }
        is_explicit_ = false;
        if (!std::exchange(prepared, true)) prepare();
        const auto tried = this->attempted([&] { return try_step(end); });
        if (!(tried.error <= S(1))) rest_ = 0;
        return tried;
      });
    } else {
      prepare();
      base::take_step(steps, t_end, [&](const S& end) { return this->attempted([&] { return try_step(end); }); });
    }
  }
  /// Whether the last step was explicit.
  bool is_explicit() const {
    if constexpr (base::settles) {
      return is_explicit_;
    } else {
      return false;
    }
  }
  /// After an explicit step: the slopes at its ends as rates of the displacement from its start, and that at its end as
  /// a rate of the state.
  const rate& first_slope() const { return k_.front(); }
  const rate& last_slope() const { return k_.back(); }
  const rate& slope_at_end() const { return slope_at_end_; }
  /// The displacement to the fraction theta of an explicit step; a cubic.
  auto explicit_displacement(const S& theta) const {
    return detail::hermite_cubic(theta, S(this->time_ - this->previous_time_), this->displacement(), k_.front(),
                                 k_.back());
  }

 private:
  bool is_nearly_singular() const {
    if constexpr (requires { this->system().singular_distance(this->x_); }) {
      const S d = this->system().singular_distance(this->x_);
      const S noise = 10 * std::numeric_limits<S>::epsilon(), cube = d * d * d;
      for (Eigen::Index i = 0; i < this->rates(); ++i)
        if (noise > cube * (this->tolerances_.absolute[i] + this->tolerances_.relative[i])) return true;
    }
    return false;
  }
  detail::attempt<S> try_explicit_step(const rate& slope, const S& end) {
    const S h = end - this->time_;
    this->settle_at(end);
    k_.front() = slope;
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(h, end), ...); }
    (std::make_index_sequence<tableau::stages - 1>{});
    if (!this->next_is_finite()) return {std::numeric_limits<S>::quiet_NaN()};
    this->check_end();
    const auto& e = this->tangential(h * detail::difference<tableau::a.back(), tableau::embedded>(k_));
    return {detail::error_norm(this->tolerances_, e, this->magnitudes(this->x_), this->magnitudes(this->next_))};
  }
  template <std::size_t I>
  void stage(const S& h, const S& end) {
    constexpr bool last = I + 1 == tableau::stages;
    this->displace(h * detail::combination<tableau::a[I]>(k_));
    if constexpr (last) this->settle_next();
    this->evaluate(detail::stage_time<S, tableau::c[I]>(this->time_, h, end), this->next_, k_[I]);
    if constexpr (last) slope_at_end_ = k_[I];
    this->pull_back(k_[I]);
  }

  bool is_explicit_ = false;
  int rest_ = 0, last_rest_ = 0;  ///< steps until the next explicit try; those after the last try
  std::array<rate, tableau::stages> k_;
  rate slope_at_end_;
};

}  // namespace kte
