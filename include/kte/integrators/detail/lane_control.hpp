#pragma once

#include <kte/integrators/detail/rounding_floor.hpp>
#include <kte/integrators/detail/step_choice.hpp>
#include <kte/integrators/embedded_runge_kutta.hpp>
#include <kte/integrators/fixed_step_runge_kutta.hpp>

#include <vector>

namespace kte::detail {

/// The reasons of failures of lanes, in the words of `integrator`.
template <class S>
struct lane_failures {
  [[noreturn, gnu::cold]] static void fail(const S& time, const std::string& why, failure_reason reason) {
    const auto t = static_cast<double>(time);
    raise<integration_failure>("kte: integration stopped at t = " + number(t) + ": " + why, t, reason, std::string(),
                               -1);
  }
  [[noreturn, gnu::cold]] static void fail_not_finite(const S& time) {
    fail(time, "the next state is not a finite number", failure_reason::not_finite);
  }
  static auto failing(const S& time) {
    return [&time](const std::string& why, failure_reason reason) { fail(time, why, reason); };
  }
};

/// The steps of lanes, each as those of a solver alone. Fixed steps: grids of times.
template <class Solver, bool IsAdaptive, class State, std::size_t Width>
class lane_control : public lane_failures<typename State::Scalar> {
  using S = typename State::Scalar;

 public:
  explicit lane_control(const Solver& s) : step_(s.step_length()) {}
  void begin(std::size_t i, const S& t, const S& goal, Eigen::Index) {
    grid_[i] = time_grid<S>(t, goal, step_, "step"), index_[i] = 0;
  }
  template <class State_>
  S propose(std::size_t i, const S&, const S&, const State_&) {
    return grid_[i][++index_[i]];
  }
  void begin_step(std::size_t) {}

 private:
  S step_;
  std::array<time_grid<S>, Width> grid_{};
  std::array<long long, Width> index_{};
};

/// Adaptive steps, with the tolerances of the solver.
template <class Solver, class State, std::size_t Width>
class lane_control<Solver, true, State, Width> : public lane_failures<typename State::Scalar> {
  using S = typename State::Scalar;
  using failures = lane_failures<S>;

 public:
  explicit lane_control(const Solver& s) : bounds_(s.bounds()) {
    for (std::size_t i = 0; i < Width; ++i) steps_.emplace_back(Solver::order_of_error());
  }
  void begin(std::size_t i, const S&, const S&, Eigen::Index n) {
    steps_[i].start(bounds_, n);
    steps_[i].begin_step();
  }
  void begin_step(std::size_t i) { steps_[i].begin_step(); }
  void check_slope(const S& t, const State& slope) const {
    if (!all_finite(slope)) [[unlikely]]
      failures::fail(t, "the right-hand side is not a finite number", failure_reason::not_finite);
  }
  template <class Slope>
  void choose_first(std::size_t i, const S& t, const S& goal, const State& slope, const State& x,
                    const Slope& slope_after) {
    floor_[i] = {}, tries_[i] = 0;
    steps_[i].choose_first(t, goal, bounds_, slope, x, slope_after, failures::failing(t));
  }
  template <class Sizes>
  S propose(std::size_t i, const S& t, const S& goal, const Sizes& sizes) {
    ++tries_[i];
    return steps_[i].propose(t, goal, bounds_, sizes, failures::failing(t));
  }
  bool judge(std::size_t i, const S& error) { return steps_[i].judge({error}, bounds_); }

  /// `error_norm` of all lanes; not finite where it is to be computed alone.
  template <class X>
  auto norms(const X& e, const X& x0, const X& x1) const {
    return lane_norms(bounds_, e, x0, x1);
  }
  S norm(const State& e, const State& x0, const State& x1) const { return error_norm(bounds_, e, x0, x1); }
  /// Whether an error may be due to rounding (`rounding_floor`).
  bool may_be_rounding(std::size_t i, const S& error) const { return !(error <= S(1) && floor_[i].is_below()); }
  template <class Rounding>
  S level(std::size_t i, const S& error, const S& reach, const State& slope, const State& x, const Rounding& rounding) {
    using std::abs;
    const auto norm = [&](const State& r) { return error_norm(bounds_, r, x, x); };
    return floor_[i].level(
        error, abs(reach), tries_[i] - 1, [&] { return norm(slope); },
        [&](int a, int b) { return norm(rounding(a, b)); });
  }
  /// n roundings of a time or a state.
  static S roundings(int n, const S& t) {
    using std::abs;
    return S(n) * std::numeric_limits<S>::epsilon() * abs(t);
  }
  static State roundings(int n, const State& x) {
    State r = S(n) * std::numeric_limits<S>::epsilon() * x;
    for (Eigen::Index i = 0; i < r.size(); i += 2) r[i] = -r[i];
    return r;
  }

 private:
  tolerances<S> bounds_;
  std::vector<step_choice<S>> steps_;
  std::array<rounding_floor<S>, Width> floor_{};
  std::array<long long, Width> tries_{};
};

}  // namespace kte::detail
