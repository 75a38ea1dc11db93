#pragma once

#include <kte/integrators/detail/hermite.hpp>
#include <kte/integrators/detail/lane_control.hpp>
#include <kte/integrators/embedded_runge_kutta.hpp>
#include <kte/integrators/fixed_step_runge_kutta.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

namespace kte::detail {

template <class T, class F, class X>
T tableau_of(const embedded_runge_kutta<T, F, X>*);
template <class T, class F, class X>
T tableau_of(const fixed_step_runge_kutta<T, F, X>*);
/// Whether a solver is an explicit Runge-Kutta method on packs whose right-hand side takes a pack of times.
template <class Solver>
concept steps_in_lanes = is_pack<typename std::remove_cvref_t<decltype(std::declval<Solver&>().state())>::Scalar> &&
    requires(const Solver& s) {
  tableau_of(&s);
  right_hand_side::of(s)(s.state()[0], s.state());
};

/// The steps of an explicit Runge-Kutta method on packs, whose lanes have their own times, steps, and step control. In
/// each lane it computes what the method computes for this lane alone (embedded_runge_kutta.hpp,
/// fixed_step_runge_kutta.hpp).
template <class Solver>
class lane_stepper {
 public:
  using X = std::remove_cvref_t<decltype(std::declval<Solver&>().state())>;
  using P = typename X::Scalar;
  using S = typename P::value_type;
  using tableau = decltype(tableau_of(static_cast<const Solver*>(nullptr)));
  using lane_state = Eigen::Matrix<S, X::RowsAtCompileTime, 1>;
  static constexpr std::size_t width = std::size_t{P::lanes}, stages = tableau::stages;
  static constexpr bool is_adaptive = requires { tableau::embedded; };

  /// Takes the settings of a solver. Lanes are idle until `place`.
  explicit lane_stepper(const Solver& s) : x_(s.state()), next_(x_), lost_(0 * x_), total_(x_), control_(s) {
    k_.fill(lost_);
    time_.fill(s.time()), end_ = time_, active_.fill(false), accepted_.fill(false), needs_slope_.fill(false);
    is_new_.fill(false);
  }

  /// Lane i begins at a time and state; `is_new`: without a known step.
  void place(std::size_t i, const S& t, const lane_state& x, bool is_new) {
    for (Eigen::Index k = 0; k < x_.size(); ++k) x_[k].set(i, x[k]);
    time_[i] = t, active_[i] = needs_slope_[i] = true, is_new_[i] |= is_new;
    control_.begin_step(i);
  }
  void begin(std::size_t i, const S& goal) {
    control_.begin(i, time_[i], goal, x_.size());
    if constexpr (!is_adaptive)
      for (Eigen::Index k = 0; k < x_.size(); ++k) lost_[k].set(i, S(0));
  }
  void leave(std::size_t i) { active_[i] = false; }
  const S& time(std::size_t i) const { return time_[i]; }
  void state(std::size_t i, lane_state& x) const { read(x_, i, x); }

  /// A step in all active lanes towards their goals, or a try that `has_stepped` denies. failed(lane, exception): a
  /// lane that cannot go on.
  template <class F, class Failed>
  void advance(F& f, const std::array<S, width>& goal, const Failed& failed) {
    if constexpr (is_adaptive) prepare(f, goal, failed);
    for (std::size_t i = 0; i < width; ++i) {
      end_[i] = time_[i];
      if (active_[i])
        or_leave(i, failed, [&] { end_[i] = control_.propose(i, time_[i], goal[i], [&] { return of(x_, i); }); });
    }
    const P t = pack_of(time_), end = pack_of(end_);
    h_ = end - t;
    within_.fill(false);
    if constexpr (!is_adaptive) k_[0] = f(t, x_);
    [&]<std::size_t... I>(std::index_sequence<I...>) { (stage<I + 1>(f, t, end), ...); }
    (std::make_index_sequence<stages - 1>{});
    if constexpr (is_adaptive) {
      judge(f, failed);
    } else {
      total_ = h_ * combination<tableau::weights>(k_) + lost_;
      next_ = x_ + total_;
      const P zero = zero_or_nan();
      for (std::size_t i = 0; i < width; ++i) {
        accepted_[i] = active_[i];
        if (active_[i] && zero[i] != S(0)) or_leave(i, failed, [&] { control_.fail_not_finite(time_[i]); });
      }
    }
  }
  bool has_stepped(std::size_t i) const { return active_[i] && accepted_[i]; }
  /// The end of the step of a lane, before `commit`.
  const S& end(std::size_t i) const { return end_[i]; }
  void end_state(std::size_t i, lane_state& x) const { read(next_, i, x); }
  /// The state of lane i at the fraction theta of its step, before `commit`.
  void within(std::size_t i, const S& theta, lane_state& x) {
    using std::abs;
    const S eighth = S(8) * theta, nearest = std::round(eighth);
    if (abs(S(eighth - nearest)) > 8 * std::numeric_limits<S>::epsilon()) return read(dense(P(theta)), i, x);
    const auto n = static_cast<std::size_t>(nearest);  // those that all lanes search
    if (!within_[n]) within_state_[n] = dense(P(nearest / S(8))), within_[n] = true;
    read(within_state_[n], i, x);
  }
  /// Moves the lanes that have stepped and not been placed elsewhere to the ends of their steps. `moved`: by lane.
  void commit(const std::array<bool, width>& moved) {
    P flag(0);
    for (std::size_t i = 0; i < width; ++i) {
      if (!moved[i]) continue;
      flag.set(i, S(1)), time_[i] = end_[i];
      control_.begin_step(i);
    }
    const auto stepped = flag > P(0);
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      if constexpr (is_adaptive)
        k_.front()[k] = select(stepped, k_[stages - 1][k], k_.front()[k]);
      else
        lost_[k] = select(stepped, P(total_[k] - (next_[k] - x_[k])), lost_[k]);
      x_[k] = select(stepped, next_[k], x_[k]);
    }
  }

 private:
  static P pack_of(const std::array<S, width>& x) { return P::load(x.data()); }
  static void read(const X& from, std::size_t i, lane_state& x) {
    x.resize(from.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] = from[k][i];
  }
  static lane_state of(const X& from, std::size_t i) {
    lane_state x;
    read(from, i, x);
    return x;
  }
  template <class Failed, class Body>
  void or_leave(std::size_t i, const Failed& failed, const Body& body) {
    try {
      body();
    } catch (const std::exception& e) {
      active_[i] = accepted_[i] = false;
      failed(i, e);
    }
  }
  /// 0 in the lanes whose next state is finite, otherwise NaN.
  P zero_or_nan() const {
    P sum(0);
    for (Eigen::Index k = 0; k < next_.size(); ++k) sum += next_[k] * P(0);
    return sum;
  }

  template <std::size_t I, class F>
  void stage(F& f, const P& t, const P& end) {
    next_ = x_ + h_ * combination<tableau::a[I]>(k_);
    k_[I] = f(stage_time<P, tableau::c[I]>(t, h_, end), next_);
  }
  /// Slopes of lanes that begin somewhere, and first steps of new ones.
  template <class F, class Failed>
  void prepare(F& f, const std::array<S, width>& goal, const Failed& failed) {
    P flag(0);
    bool any = false;
    for (std::size_t i = 0; i < width; ++i)
      if (active_[i] && needs_slope_[i]) flag.set(i, S(1)), any = true;
    if (!any) return;
    const auto needed = flag > P(0);
    const P t = pack_of(time_);
    k_[stages - 1] = f(t, x_);
    for (Eigen::Index k = 0; k < x_.size(); ++k) k_.front()[k] = select(needed, k_[stages - 1][k], k_.front()[k]);
    for (std::size_t i = 0; i < width; ++i) {
      if (!active_[i] || !needs_slope_[i]) continue;
      needs_slope_[i] = false;
      const bool first = std::exchange(is_new_[i], false);
      const auto slope = of(k_.front(), i);
      or_leave(i, failed, [&] {
        control_.check_slope(time_[i], slope);
        if (!first) return;
        control_.choose_first(i, time_[i], goal[i], slope, of(x_, i),
                              [&](const S& h) { return slope_from(f, i, h, lane_state(h * slope)); });
      });
    }
  }
  /// The slope of lane i at another time, displaced by d; the other lanes stay.
  template <class F>
  lane_state slope_from(F& f, std::size_t i, const S& dt, const lane_state& d) {
    P t = pack_of(time_);
    t.set(i, time_[i] + dt);
    next_ = x_;
    for (Eigen::Index k = 0; k < d.size(); ++k) next_[k].set(i, x_[k][i] + d[k]);
    return of(X(f(t, next_)), i);
  }
  template <class F, class Failed>
  void judge(F& f, const Failed& failed) {
    const X e = h_ * difference<tableau::a.back(), tableau::embedded>(k_);
    const P norms = control_.norms(e, x_, next_), zero = zero_or_nan();
    std::array<bool, width> asks{};
    for (std::size_t i = 0; i < width; ++i) {
      accepted_[i] = false;
      if (!active_[i]) continue;
      S error = norms[i];
      if (zero[i] != S(0))
        error = std::numeric_limits<S>::quiet_NaN();
      else if (!is_finite(error))
        error = control_.norm(of(e, i), of(x_, i), of(next_, i));
      error_[i] = error;
      asks[i] = is_finite(error) && control_.may_be_rounding(i, error);
      if (!asks[i]) accepted_[i] = control_.judge(i, error);
    }
    if (std::none_of(asks.begin(), asks.end(), [](bool x) { return x; })) return;
    const X end_states = next_;
    for (std::size_t i = 0; i < width; ++i) {
      if (!asks[i]) continue;
      or_leave(i, failed, [&] {
        const auto x = of(x_, i), slope = of(k_.front(), i);
        const auto rate = [&](int n) {
          return n == 0 ? slope : slope_from(f, i, control_.roundings(n, time_[i]), control_.roundings(n, x));
        };
        constexpr double share = Solver::share_of_rounding_errors();
        const S level = control_.level(i, error_[i], S(h_[i] * S(share)), slope, x,
                                       [&](int a, int b) { return lane_state(rate(b) - rate(a)); });
        accepted_[i] = control_.judge(i, S(error_[i] / level));
      });
    }
    next_ = end_states;
  }
  X dense(const P& theta) const {
    if constexpr (is_adaptive) {
      const P r = (P(1) - theta) * theta, weight = r * r * h_;
      const X cubic = hermite_cubic(theta, h_, X(next_ - x_), k_.front(), k_[stages - 1]);
      static_assert(
          !requires { typename tableau::extension; },
          "kte: events in lanes need dense output without further evaluations, such as that of "
          "dormand_prince45");
      if constexpr (requires { tableau::dense; })
        return x_ + cubic + weight * combination<tableau::dense>(k_);
      else
        return x_ + cubic;
    } else {
      X d = 0 * x_;
      P power = h_;
      [&]<std::size_t... I>(std::index_sequence<I...>) {
        ((power *= theta, d += power * combination<tableau::interpolant[I]>(k_)), ...);
      }
      (std::make_index_sequence<tableau::interpolant.size()>{});
      return x_ + d;
    }
  }

  X x_, next_, lost_, total_;
  std::array<X, stages> k_;
  P h_{0};
  std::array<S, width> time_, end_, error_{};
  std::array<bool, width> active_, accepted_, needs_slope_, is_new_;
  std::array<X, 9> within_state_;
  std::array<bool, 9> within_{};
  lane_control<Solver, is_adaptive, lane_state, width> control_;
};

}  // namespace kte::detail
