#pragma once

#include <kte/models/runtime_dynamics_model.hpp>

namespace kte_tool {

/// x' = f(t, x) of a chain whose inputs follow a law, at every evaluation: of one type, whatever the law.
class plant {
 public:
  using model_type = kte::manipulator_dynamics_model<kte::runtime_chain>;
  using S = double;
  using state = model_type::state;
  using rate = model_type::rate;
  using jacobian_matrix = model_type::jacobian_matrix;
  /// Puts the inputs at t and x into u.
  using law = std::function<void(double t, const state& x, Eigen::VectorXd& u)>;

  /// A law of the time alone does not change the derivatives of f by x.
  plant(const kte::runtime_chain& c, law l, bool of_time_alone)
      : model_(c), u_(model_.input()), law_(std::move(l)), of_time_alone_(of_time_alone) {
    if (law_) model_.let_inputs_move();
  }

  model_type& model() { return model_; }
  const model_type& model() const { return model_; }
  void set_inputs(double t, const state& x) const {
    if (!law_) return;
    law_(t, x, u_);
    model_.setInput(u_);
  }
  /// The state of q and v at t, on the loops, which inputs may move.
  state make_x(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
    if (model_.has_loops() && q.size() == model_.nq() && v.size() == model_.dofs()) {
      state x = state::Zero(q.size() + v.size() + model_.internals());
      x.head(q.size()) = q, x.segment(q.size(), v.size()) = v;
      set_inputs(t, x), settle_at(t);
    }
    return model_.make_x(q, v);
  }
  /// Whether the inputs depend on x.
  bool follows_state() const { return law_ && !of_time_alone_; }
  const rate& operator()(double t, const state& x) {
    set_inputs(t, x);
    return model_(t, x);
  }
  bool jacobian(double t, const state& x, jacobian_matrix& j) {
    if (follows_state()) return false;
    set_inputs(t, x);
    return model_.jacobian(t, x, j);
  }
  /// With all frames, accelerations and forces; valid until the next call.
  const kte::runtime_state& state_at(double t, const state& x) {
    set_inputs(t, x);
    return model_.state_at(t, x);
  }

  // What integrators ask of a model.
  Eigen::Index rates() const { return model_.rates(); }
  auto freedoms() const { return model_.freedoms(); }
  auto velocities_of(const state& x) const { return model_.velocities_of(x); }
  auto internals_of(const state& x) const { return model_.internals_of(x); }
  void displace(const state& x, const rate& d, state& out) const { model_.displace(x, d, out); }
  void pull_back(const rate& d, rate& r) const { model_.pull_back(d, r); }
  void magnitudes(const state& x, rate& m) const { model_.magnitudes(x, m); }
  void rounding(const state& x, const rate& d, const state& out, rate& rest) const { model_.rounding(x, d, out, rest); }
  bool has_loops() const { return model_.has_loops(); }
  void settle_at(double t) const {
    settling_ = t;
    model_.settle_at(t);
  }
  void begin_step(const state& x) const {
    move_constraints(x);
    model_.begin_step(x);
  }
  void settle(const state& x, rate& d, state& out) const {
    move_constraints(out);
    model_.settle(x, d, out);
  }
  void tangential(const state& x, rate& e) const { model_.tangential(x, e); }
  void check_end(const state& x, const state& next) const { model_.check_end(x, next); }

 private:
  /// Inputs may move the surfaces of contacts and the frames of closures.
  void move_constraints(const state& x) const {
    if (model_.has_loops() || model_.contacts() > 0) set_inputs(settling_, x);
  }

  mutable model_type model_;  // its inputs
  mutable Eigen::VectorXd u_;
  law law_;
  bool of_time_alone_;
  mutable double settling_ = 0;  ///< the time of states that are put on constraints
};

}  // namespace kte_tool
