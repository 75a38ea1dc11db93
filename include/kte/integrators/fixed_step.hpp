#pragma once

#include <kte/integrators/detail/fixed_point.hpp>
#include <kte/integrators/integrator.hpp>

namespace kte {

/// Base of methods with a fixed step. The rounding error of a step is added to the next one (compensated summation,
/// Kahan 1965; Hairer, Lubich and Wanner, Geometric Numerical Integration, 2006, VIII.5), so that rounding errors of
/// many small steps do not accumulate. Steps are counted from the start of each `integrate`; the last one is shorter if
/// the step does not divide the time. A method derives from this class with itself as `Method` and has
///
///   try_step(end)     one step to the time `end`: stores the new state in `next_` by `displace_at_last`
///   dense(theta, x)   as for `integrator`
///   prepare()         optional: called before the first step of each `integrate`
template <class Method, class F, class X>
class fixed_step : public integrator<Method, F, X> {
  using base = integrator<Method, F, X>;
  friend base;

 public:
  using typename base::rate;
  using typename base::S;
  /// The length of a step, s.
  [[nodiscard]] const S& step_length() const { return step_; }

 protected:
  fixed_step(F f, const S& t0, const X& x0, const S& step) : base(std::move(f), t0, x0), step_(step) {
    detail::check_positive(step, "step");
    lost_ = total_ = this->no_rate();
  }
  /// next_ = state (+) d, plus the rounding errors of earlier steps.
  template <class D>
  void displace_with_lost(const D& d) {
    total_ = d + lost_;
    this->displace(total_);
  }
  /// The new state with compensated summation.
  template <class D>
  void displace_at_last(const D& d) {
    displace_with_lost(d);
    if constexpr (!base::on_group) {
      lost_ = total_ - (this->next_ - this->x_);
      this->settle_next();
    } else {
      this->settle_next();
      if constexpr (base::settles) total_ = this->displacement();
      if constexpr (requires { this->system().rounding(this->x_, total_, this->next_, lost_); })
        this->system().rounding(this->x_, total_, this->next_, lost_);
    }
  }
  /// `detail::iterate` of a slope k within a step h, where step() returns the changes of k and the size of k. Bodies at
  /// rest may have a k of rounding errors of forces in equilibrium: such changes are negligible if they move the state
  /// by less than its rounding. Values that are not finite remain, so that `advance` rejects the new state.
  template <class Step>
  void iterate_slope(const S& h, const Step& step) const {
    using std::abs;
    S change(0);
    iterate(
        h,
        [&] {
          const auto [moved, size] = step();
          change = moved;
          return size == S(0) ? moved : S(moved / size);
        },
        [&] { return abs(h) * change <= std::numeric_limits<S>::epsilon() * this->x_.norm(); });
  }
  template <class Step>
  void iterate(const S& h, const Step& step) const {
    iterate(h, step, [] { return false; });
  }
  template <class Step, class Negligible>
  void iterate(const S& h, const Step& step, const Negligible& negligible) const {
    if (detail::iterate<S>(step, negligible) == detail::iteration::too_long) [[unlikely]]
      this->fail("the iteration of a step of " + detail::number(detail::as_double(h)) +
                     " does not converge: it is too long" + near_singular(),
                 failure_reason::no_convergence);
  }

 private:
  /// For messages: that constraints are near a singular configuration, if they are.
  std::string near_singular() const {
    if constexpr (base::settles && requires { this->system().singular_distance(this->x_); }) {
      const double d = detail::as_double(this->system().singular_distance(this->x_));
      if (d < 0.1)
        return ", or the constraints are too near to a singular configuration, at a relative distance of " +
               detail::number(d);
    }
    return "";
  }
  void start(const S& t_end) {
    grid_ = time_grid<S>(this->time_, t_end, step_, "step");
    index_ = 0;
    lost_.setZero();
    if constexpr (requires(Method & m) { m.prepare(); }) static_cast<Method&>(*this).prepare();
  }
  void advance(const S&) {
    this->previous_time_ = this->time_;  // the data of the last step become invalid
    const S end = grid_[++index_];
    this->settle_at(end);
    const bool computed = this->computes([&] { static_cast<Method&>(*this).try_step(end); }, this->next_);
    if (!computed || !this->next_is_finite()) [[unlikely]]
      this->fail("the next state is not a finite number", failure_reason::not_finite);
    this->accept(end);
  }

  S step_;
  rate lost_, total_;
  time_grid<S> grid_;
  long long index_ = 0;
};

}  // namespace kte
