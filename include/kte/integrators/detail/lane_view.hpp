#pragma once

#include <kte/integrators/detail/lane_stepper.hpp>

namespace kte::detail {

/// One lane of a `lane_stepper` as a solver, for the search of events: its last step, and where it goes on.
template <class Stepper>
class lane_view {
 public:
  using S = typename Stepper::S;
  using X = typename Stepper::lane_state;

  lane_view(Stepper& all, std::size_t lane, const S& t, const X& x)
      : all_(all), lane_(lane), time_(t), begin_(t), goal_(t), x_(x), start_(x) {}

  const S& time() const { return time_; }
  const X& state() const { return x_; }
  const S& goal() const { return goal_; }
  void begin(const S& goal) {
    goal_ = goal;
    is_placed_ = true;
  }
  void restart(const S& t, const X& x, keep_step_t) {
    time_ = begin_ = t, x_ = start_ = x;
    is_placed_ = has_moved_ = true;
  }
  void restart(const S& t, const X& x) { restart(t, x, keep_step); }
  /// Takes over the last step of the lane.
  void take_step() {
    begin_ = time_, start_ = x_;
    time_ = all_.end(lane_);
    all_.end_state(lane_, x_);
  }
  void interpolate(const S& t, X& x) const {
    if (t == time_)
      x = x_;
    else if (t == begin_)
      x = start_;
    else
      all_.within(lane_, S((t - begin_) / (time_ - begin_)), x);
  }
  /// Whether its goal or place has been set since the last call: then the stepper must begin there.
  bool is_placed() { return std::exchange(is_placed_, false); }
  bool has_moved() { return std::exchange(has_moved_, false); }

 private:
  Stepper& all_;
  std::size_t lane_;
  S time_, begin_, goal_;
  X x_, start_;
  bool is_placed_ = false, has_moved_ = false;
};

}  // namespace kte::detail
