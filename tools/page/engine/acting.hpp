#pragma once

#include <kte/dynamics/joint_reactions.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include "thing_loads.hpp"

namespace kte::page {

using dynamics_model = manipulator_dynamics_model<runtime_chain>;

/// What an element exerts on one of the things that it acts on: number `which` of its frames, or of its coordinates. On
/// a frame in axes of the world, at its origin; on a coordinate of one number in force.x, on others in its own axes.
struct exerted {
  std::size_t element;
  bool on_frame;
  int which;
  kte::page::load load;
};

/// The loads in a mechanism at a state: of its elements, one by one, and of its joints.
class acting {
 public:
  /// frames: those whose reactions are needed.
  acting(dynamics_model m, std::vector<handle> frames)
      : model_(std::move(m)), frames_(std::move(frames)), state_(model_.chain().make_state()) {}

  /// At x = (q, v, z), with inputs as the model has them.
  void at(double t, const Eigen::VectorXd& x) {
    model_.setJointStates(t, x, state_);
    accelerations_ = model_.computeStateRate(t, x).segment(model_.dofs(), model_.dofs());
    set_accelerations(state_, accelerations_);
    pass();
  }
  /// Loads of a recorded state: v, and the numbers of inputs, vectors and internal states. Unknown loads are NaN, and
  /// so are loads that depend on it; so are accelerations where something else acted (free = false), or contacts.
  /// Throws `bad_argument` for wrong sizes.
  template <indexable Q, indexable V, indexable Signals>
  void at(double t, const Q& q, const V& v, const Signals& signals, bool free = true) {
    if (v.size() != static_cast<std::size_t>(model_.dofs()) || signals.size() != signal_count())
      throw bad_argument("kte: " + std::to_string(v.size()) + " velocities and " + std::to_string(signals.size()) +
                         " signals, not " + std::to_string(model_.dofs()) + " and " + std::to_string(signal_count()));
    Eigen::VectorXd u(model_.input().size()), z = Eigen::VectorXd::Zero(model_.internals());
    const auto inputs = static_cast<std::size_t>(model_.wiring().count(kind::input));
    for (const auto& s : model_.wiring().signals) {
      const auto slot = static_cast<std::size_t>(s.slot);
      if (s.u < 0) continue;
      if (s.what == kind::input) u[s.u] = signals[slot];
      if (s.what == kind::vector)
        for (int k = 0; k < 3; ++k) u[s.u + k] = signals[inputs + 3 * slot + static_cast<std::size_t>(k)];
    }
    const int own = model_.wiring().count(kind::internal);
    for (int i = 0; i < own; ++i) z[i] = signals[signals.size() - static_cast<std::size_t>(own - i)];
    const auto x = model_.make_x(q, v, z);
    if (free && model_.contacts() == 0 && x.allFinite() && u.allFinite()) return model_.setInput(u), at(t, x);
    set_positions(state_, x.head(model_.nq()).eval());
    set_velocities(state_, x.segment(model_.nq(), model_.dofs()).eval());
    accelerations_.setConstant(model_.dofs(), unknown);
    set_accelerations(state_, accelerations_);
    put_signals(t, u, z);
    pass();
  }

  /// Those numbers of a model at x, as `at` takes them.
  static std::vector<double> signals_of(const dynamics_model& m, double t, const Eigen::VectorXd& x) {
    std::vector<double> all(signal_count(m));
    const auto inputs = static_cast<std::size_t>(m.wiring().count(kind::input));
    for (const auto& s : m.wiring().signals) {
      const auto slot = static_cast<std::size_t>(s.slot);
      if (s.what == kind::input) all[slot] = s.u >= 0 ? m.input()[s.u] : t;
      if (s.what == kind::vector)
        for (std::size_t k = 0; k < 3; ++k) all[inputs + 3 * slot + k] = m.input()[s.u + static_cast<int>(k)];
    }
    const int own = m.wiring().count(kind::internal);
    for (int i = 0; i < own; ++i) all[all.size() - static_cast<std::size_t>(own - i)] = x[m.nq() + m.dofs() + i];
    return all;
  }

  const Eigen::VectorXd& accelerations() const { return accelerations_; }
  const std::vector<exerted>& loads() const { return loads_; }
  /// By which the joint or link that moves each frame acts on what is beyond it, in axes of the world.
  const std::vector<load>& reactions() const { return reactions_; }

 private:
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::size_t signal_count() const { return signal_count(model_); }
  static std::size_t signal_count(const dynamics_model& m) {
    const auto count = [&m](kind k) { return static_cast<std::size_t>(m.wiring().count(k)); };
    return count(kind::input) + 3 * count(kind::vector) + count(kind::internal);
  }
  void put_signals(double t, const Eigen::VectorXd& u, const Eigen::VectorXd& z) {
    for (int i = 0; i < model_.wiring().count(kind::internal); ++i) state_.get<kind::internal>(i).z = z[i];
    for (const auto& s : model_.wiring().signals)
      if (s.what == kind::vector)
        state_.get<kind::vector>(s.slot) = {u[s.u], u[s.u + 1], u[s.u + 2]};
      else
        state_.get<kind::input>(s.slot) = s.u >= 0 ? u[s.u] : t;
  }

  template <class Visit>
  void with_thing(kind k, int i, const Visit& visit) {
    if (is_frame(k))
      detail::with_frame(state_, k, i, visit);
    else if (!is_signal(k))
      detail::with_coordinate(state_, k, i, visit);
  }

  /// All forces, from the last element to the first.
  void pass() {
    const auto& c = model_.chain();
    c.doMotion(state_), c.clearForce(state_);
    loads_.clear(), reactions_.clear();
    const auto& all = c.wiring().elements;
    for (std::size_t i = all.size(); i-- > 0;)
      if (all[i].rigid)
        all[i].element->doForce(state_);
      else
        measure(i, all[i]);
    for (auto& e : loads_) {
      const auto& x = all[e.element];
      // what all others leave of equilibrium
      if (!e.on_frame && x.element->holds(state_)) e.load.force.x = -state_.get<kind::gen>(x.index[0]).f;
    }
    for (const auto& frame : frames_)
      detail::with_frame(state_, frame.what(), frame.index(), [this](const auto& x) {
        const auto w = in_world(x, load_on(x));
        reactions_.push_back({-w.force, -w.torque});
      });
  }
  /// What an element adds to the loads of its ports.
  void measure(std::size_t element, const topology::connection& e) {
    const auto each = [&](const auto& visit) {
      for (std::size_t p = 0; p < e.ports.size(); ++p)
        with_thing(e.ports[p].what, e.index[p], [&](auto& x) { visit(p, x); });
    };
    before_.assign(e.ports.size(), load{});
    each([this, &e](std::size_t p, auto& x) {
      if (e.ports[p].how == access::out) return;  // what it passes on
      before_[p] = load_on(x);
      put_load(x, load{});
    });
    e.element->doForce(state_);
    int frames = 0, coordinates = 0;
    each([&](std::size_t p, auto& x) {
      const bool on_frame = is_frame(e.ports[p].what);
      const int which = on_frame ? frames++ : coordinates++;
      if (e.ports[p].how == access::out) return;
      const auto own = load_on(x);
      auto& w = loads_.emplace_back(exerted{element, on_frame, which, own}).load;
      if constexpr (requires { x.ang_acceleration; }) {
        if (on_frame) w = in_world(x, own);
      }
      put_load(x, {before_[p].force + own.force, before_[p].torque + own.torque});
    });
  }

  dynamics_model model_;
  std::vector<handle> frames_;
  runtime_state state_;
  Eigen::VectorXd accelerations_;
  std::vector<exerted> loads_;
  std::vector<load> reactions_, before_;
};

}  // namespace kte::page
