#pragma once

#include <optional>

#include "simulation.hpp"

namespace kte::page {

/// A mechanism and its simulation, with the actions of the viewer.
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

  /// Pulls a frame, or where it has no name none. Throws `unknown_name`, `bad_argument`.
  void pull(const page_pull& by) {
    check(by);
    if (!by.frame.empty()) (void)shown_.chain().frame(by.frame);
    const bool same = by.frame == pull_.frame;
    pull_ = by;
    if (!same) rebuild();
  }
  /// Damps all coordinates, N s/m and Nm s/rad. Throws `bad_argument`.
  void damp(double c) {
    check_not_negative(c, "the damping");
    const bool same = (c != 0) == (damping_ != 0);
    damping_ = c;
    if (!same) rebuild();
  }

  /// The loads of a recorded state (`acting::at`), with the pull, which is the element after those of the model. Valid
  /// until the next call, as the others.
  template <indexable Q, indexable V, indexable Signals>
  const acting& loads(double t, const Q& q, const V& v, const Signals& signals, bool free) {
    if (!recorded_) recorded_.emplace(shown_.acting_in(shown_.modelled(with_pull())));
    recorded_->at(t, q, v, signals, free);
    return *recorded_;
  }
  /// At rest, with inputs as in the file.
  template <indexable Q>
  const acting& loads_at_rest(const Q& q) {
    if (!at_rest_) at_rest_.emplace(shown_.acting_in(shown_.model()));
    const auto& m = shown_.model();
    at_rest_->at(0, m.make_x(q, Eigen::VectorXd::Zero(m.dofs()).eval()));
    return *at_rest_;
  }
  /// The loads at the present state of the simulation, with the pull and the damping.
  const acting& loads_now() {
    const auto& s = running();
    if (!simulated_) simulated_.emplace(shown_.acting_in(shown_.modelled(with_pull_and_damping())));
    simulated_->at(s.time(), s.state());
    return *simulated_;
  }
  void track(const std::vector<std::string>& names) {
    shown_.track(names);
    recorded_.reset(), at_rest_.reset(), simulated_.reset();
  }

 private:
  static void check(const page_pull& n) {
    for (const double x : {n.point.x, n.point.y, n.point.z, n.target.x, n.target.y, n.target.z})
      if (!std::isfinite(x)) throw bad_argument("kte: a pull has points that are not finite");
    check_not_negative(n.stiffness, "the stiffness of a pull"), check_not_negative(n.damping, "the damping of a pull");
  }
  static void check_not_negative(double x, const char* what) {
    if (!(x >= 0 && std::isfinite(x)))
      throw bad_argument(std::string("kte: ") + what + " must be finite and not negative, got " + detail::number(x));
  }
  runtime_chain with_pull() const {
    return pull_.frame.empty() ? shown_.chain() : shown_.pulled(shown_.chain(), pull_);
  }
  runtime_chain with_pull_and_damping() const {
    return damping_ != 0 ? shown_.damped(with_pull(), damping_) : with_pull();
  }
  void rebuild() {
    recorded_.reset(), simulated_.reset();
    if (!simulation_) return;
    const Eigen::VectorXd x = simulation_->state();
    begin(simulation_->time(), x, simulation_->is_stiff() ? simulation::method::stiff : simulation::method::undecided);
  }
  void begin(double t, const Eigen::VectorXd& x, simulation::method m) {
    simulation_ = std::make_unique<simulation>(shown_.modelled(with_pull_and_damping()), t, x, m);
  }

  mechanism shown_;
  page_pull pull_;
  double damping_ = 0;
  std::unique_ptr<simulation> simulation_;
  std::optional<acting> recorded_, at_rest_, simulated_;
};

}  // namespace kte::page
