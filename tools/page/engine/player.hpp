#pragma once

#include <optional>

#include "simulation.hpp"

namespace kte::page {

/// A mechanism and its simulation, with what whoever looks at it does to it.
class player {
 public:
  explicit player(std::string_view json) : shown_(json) {}

  mechanism& shown() { return shown_; }
  /// Begins at t = 0. Throws `bad_argument` for wrong sizes.
  template <indexable Q, indexable V>
  void start(const Q& q, const V& v) {
    const auto& m = shown_.model();
    begin(0, m.make_x(q, v), simulation::method::undecided);
  }

  bool is_running() const { return simulation_ != nullptr; }
  /// Goes on to t_end by as many stretches as are needed while more() is true.
  template <class More>
  void advance(double t_end, const More& more) {
    auto& s = running();
    if (!(t_end >= s.time() && t_end - s.time() < 1e9))
      throw bad_argument("kte: a simulation goes on in time, by less than 1e9 s, not from " + detail::number(s.time()) +
                         " to " + detail::number(t_end));
    while (s.time() < t_end && more()) s.advance(t_end);
  }
  simulation& running() {
    if (!simulation_) throw bad_argument("kte: the simulation has not been started");
    return *simulation_;
  }

  /// Pulls a frame, or with an empty name none. Throws `unknown_name`, `bad_argument`.
  void pull(const std::optional<std::string>& frame, const pull_numbers& numbers) {
    check(numbers);
    if (frame) shown_.chain().frame(*frame);
    numbers_ = numbers;
    if (frame == frame_) return;
    frame_ = frame;
    rebuild();
  }
  /// Damps all coordinates, N s/m and Nm s/rad. Throws `bad_argument`.
  void damp(double c) {
    check_not_negative(c, "the damping");
    const bool same = (c != 0) == (damping_ != 0);
    damping_ = c;
    if (!same) rebuild();
  }

 private:
  static void check(const pull_numbers& n) {
    for (const double x : {n.point.x, n.point.y, n.point.z, n.target.x, n.target.y, n.target.z})
      if (!std::isfinite(x)) throw bad_argument("kte: a pull has points that are not finite");
    check_not_negative(n.stiffness, "the stiffness of a pull"), check_not_negative(n.damping, "the damping of a pull");
  }
  static void check_not_negative(double x, const char* what) {
    if (!(x >= 0 && std::isfinite(x)))
      throw bad_argument(std::string("kte: ") + what + " must be finite and not negative, got " + detail::number(x));
  }
  void rebuild() {
    if (!simulation_) return;
    const Eigen::VectorXd x = simulation_->state();
    begin(simulation_->time(), x, simulation_->is_stiff() ? simulation::method::stiff : simulation::method::undecided);
  }
  void begin(double t, const Eigen::VectorXd& x, simulation::method m) {
    auto chain = shown_.chain();
    if (frame_) chain = shown_.pulled(std::move(chain), *frame_, numbers_);
    if (damping_ != 0) chain = shown_.damped(std::move(chain), damping_);
    simulation_ = std::make_unique<simulation>(shown_.modelled(chain), t, x, m);
  }

  mechanism shown_;
  std::optional<std::string> frame_;
  pull_numbers numbers_;
  double damping_ = 0;
  std::unique_ptr<simulation> simulation_;
};

}  // namespace kte::page
