#pragma once

#include <kte/integrators/fixed_step.hpp>
#include <kte/integrators/tableau.hpp>

#include <algorithm>

namespace kte {

/// An Adams predictor-corrector pair of order k with a fixed step h and two evaluations (PECE). With the slopes f_n,
/// f_{n-1}, ... at previous times:
///
///   p = x_n + h (b_1 f_n + ... + b_k f_{n-k+1})                                    (1)
///   x_{n+1} = x_n + h (c_0 f(t_{n+1}, p) + c_1 f_n + ... + c_{k-1} f_{n-k+2})      (2)
///   f_{n+1} = f(t_{n+1}, x_{n+1})                                                  (3)
///
/// Between step ends: the integral of the polynomial through the k slopes of (2) with f_{n+1}, plus a cubic that closes
/// the gap due to f_{n+1} at the end. State and slope are continuous.
///
///   x(t_n + theta h) = x_n + h int_0^theta P - theta^2 (3 - 2 theta) h c_0 (f_{n+1} - f(t_{n+1}, p))      (4)
///
/// The coefficients are for equal steps. The first k - 1 steps, and the last step if h does not divide the time, are
/// Runge-Kutta steps with their interpolant. `integrate` continues with the slopes of the previous call if its last
/// step had the length h, and if time, direction and the slope f(t, x) are unchanged. Otherwise it starts again. Use a
/// one-step method for inputs that jump at every sample.
///
/// A `Formula` has `order` (k), `predictor` (0, b_1, ...), `corrector` (c_0, ...), `interpolant` (of int P the
/// coefficients of theta, theta^2, ...; of each a weight for f_{n+1}, f_n, ...), and `start`, a tableau for
/// `fixed_step_runge_kutta`.
template <class Formula, class F, class X>
class adams_bashforth_moulton : public fixed_step<adams_bashforth_moulton<Formula, F, X>, F, X> {
  using base = fixed_step<adams_bashforth_moulton, F, X>;
  friend base;
  friend typename base::integrator;
  static_assert(!base::on_group,
                "kte: this method keeps a history of slopes, which needs states that are vectors: use a one-step "
                "method, such as runge_kutta4 or runge_kutta5, or kte::vector_form(model)");

 public:
  using typename base::S;

  /// f(t, x), start time, s, start state, step, s. Throws `bad_argument` for a step that is not positive, and for a
  /// start that is not finite.
  adams_bashforth_moulton(F f, const S& t0, const std::type_identity_t<X>& x0, const S& step)
      : base(std::move(f), t0, x0, step) {
    slopes_.fill(this->no_rate());
    k_.fill(this->no_rate());
    gap_ = this->no_rate();
  }

 private:
  using start_tableau = typename Formula::start;
  static constexpr std::size_t order = Formula::order, stages = start_tableau::stages;

  /// Keeps the slopes if they lead to the present slope. `known_`: whether it is known, with the slopes one, two, ...
  /// times `h_` earlier.
  void prepare() {
    this->evaluate(this->time_, this->x_, this->next_);
    const bool restarted = this->previous_time_ == this->time_;
    if (!restarted && this->next_ == slopes_.front()) return;
    slopes_.front() = this->next_;
    known_ = 1;
    this->previous_time_ = this->time_;  // the slopes of the last step are invalid
  }
  void try_step(const S& end) {
    const S h = end - this->time_;
    this->previous_time_ = this->time_;  // the slopes of the last step are shifted
    if (!is_spacing(h, end)) known_ = 1;
    h_ = h;
    multistep_ = known_ >= order;
    if (!multistep_) runge_kutta(end);
    for (std::size_t i = order; i > 0; --i) slopes_[i].swap(slopes_[i - 1]);
    if (multistep_) predict_and_correct(end);
    if (this->next_is_finite()) {
      this->settle_next();
      this->evaluate(end, this->next_, slopes_.front());  // (3)
    }
    if (!detail::all_finite(slopes_.front())) [[unlikely]]
      this->fail("the next slope is not a finite number", failure_reason::not_finite);
    if (multistep_) gap_ = (h * detail::coefficient<S, Formula::corrector[0]>()) * (slopes_.front() - gap_);
    ++known_;
  }
  /// Whether h is the spacing of the known slopes, up to the rounding of times.
  bool is_spacing(const S& h, const S& end) const {
    using std::abs;
    const S a = abs(this->time_), b = abs(end), difference = abs(S(h - h_));
    return difference <= 8 * std::numeric_limits<S>::epsilon() * (a < b ? b : a);
  }

  void predict_and_correct(const S& end) {
    this->displace(h_ * detail::combination<Formula::predictor>(slopes_));  // (1)
    this->evaluate(end, this->next_, slopes_.front());
    this->displace(h_ * detail::combination<Formula::corrector>(slopes_));  // (2)
    gap_ = slopes_.front();
  }
  void runge_kutta(const S& end) {
    k_.front() = slopes_.front();
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(end), ...); }
    (std::make_index_sequence<stages - 1>{});
    this->displace(h_ * detail::combination<start_tableau::weights>(k_));
  }
  template <std::size_t I>
  void stage(const S& end) {
    this->displace(h_ * detail::combination<start_tableau::a[I]>(k_));
    this->slope(detail::stage_time<S, start_tableau::c[I]>(this->time_, h_, end), k_[I]);
  }

  static constexpr int degree() {
    return static_cast<int>(
        (std::max)({std::size_t{3}, Formula::interpolant.size(), start_tableau::interpolant.size()}));
  }
  void dense(const S& theta, X& x) const {
    if (multistep_) {
      x = this->previous_ - (theta * theta * (3 - 2 * theta)) * gap_;  // (4)
      add_integral<Formula::interpolant>(theta, slopes_, x);
    } else {
      x = this->previous_;
      add_integral<start_tableau::interpolant>(theta, k_, x);
    }
    this->settle_within(x);
  }
  template <auto Rows, class Slopes>
  void add_integral(const S& theta, const Slopes& slopes, X& x) const {
    S power = h_;
    [&]<std::size_t... P>(std::index_sequence<P...>) {
      ((power *= theta, x += power * detail::combination<Rows[P]>(slopes)), ...);
    }
    (std::make_index_sequence<Rows.size()>{});
  }

  std::array<X, order + 1> slopes_;  ///< f_n, f_{n-1}, ... before a step; f_{n+1}, f_n, ... after it
  std::array<X, stages> k_;
  X gap_;  ///< the last factor of (4)
  S h_{};  ///< of the last step, with its sign
  std::size_t known_ = 0;
  bool multistep_ = false;  ///< whether the last step was a multistep step, not a Runge-Kutta step
};

}  // namespace kte
