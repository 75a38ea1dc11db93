#pragma once

// Included first, so that static_assert messages appear near the top.
// clang-format off
#include <kte/integrators/integrator.hpp>
// clang-format on
#include <kte/integrators/detail/erased_system.hpp>
#include <kte/integrators/fixed_step.hpp>
#include <kte/integrators/tableau.hpp>

namespace kte {

/// An explicit Runge-Kutta method of s stages with a fixed step h:
///
///   k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j)           (1)
///   x1 = x + h sum_i b_i k_i                               (2)
///   x(t + theta h) = x + h sum_i p_i(theta) k_i            (3)
///
/// In packs, a lane has the steps and results of a state integrated alone.
///
/// For states with rotations these are the methods of Munthe-Kaas (integrators/motion_space.hpp).
/// A `Tableau` has `stages`, `c`, `a`, `weights` (b_i), and `interpolant`: the coefficients of theta, theta^2, ... in
/// p_i.
template <class Tableau, class F, class X>
class fixed_step_runge_kutta : public fixed_step<fixed_step_runge_kutta<Tableau, F, X>, F, X> {
  using base = fixed_step<fixed_step_runge_kutta, F, X>;
  friend base;
  friend typename base::integrator;

 public:
  using typename base::rate;
  using typename base::S;
  static constexpr bool integrates_packs = true;  ///< many states at once, in lanes

  /// f(t, x), start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  fixed_step_runge_kutta(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step);

 private:
  static constexpr std::size_t stages = Tableau::stages;

  void try_step(const S& end) {
    const S h = end - this->time_;
    this->evaluate(this->time_, this->x_, k_[0]);
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(h, end), ...); }
    (std::make_index_sequence<stages - 1>{});
    this->displace_at_last(h * detail::combination<Tableau::weights>(k_));  // (2)
  }
  template <std::size_t I>
  void stage(const S& h, const S& end) {
    this->displace(h * detail::combination<Tableau::a[I]>(k_));  // (1)
    this->slope(detail::stage_time<S, Tableau::c[I]>(this->time_, h, end), k_[I]);
  }
  static constexpr int degree() { return static_cast<int>(Tableau::interpolant.size()); }
  void dense(const S& theta, X& x) const {
    const S h = this->time_ - this->previous_time_;
    rate d = this->no_rate();
    S power = h;
    [&]<std::size_t... P>(std::index_sequence<P...>) {
      ((power *= theta, d += power * detail::combination<Tableau::interpolant[P]>(k_)), ...);  // (3)
    }
    (std::make_index_sequence<Tableau::interpolant.size()>{});
    this->displaced(d, x);
  }

  std::array<rate, stages> k_;
};

template <class Tableau, class F, class X>
fixed_step_runge_kutta<Tableau, F, X>::fixed_step_runge_kutta(F f, const S& t0, const std::type_identity_t<X>& x0,
                                                              const S& step)
    : base(std::move(f), t0, x0, step) {
  k_.fill(this->no_rate());
}

}  // namespace kte
