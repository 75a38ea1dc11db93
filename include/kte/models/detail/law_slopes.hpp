#pragma once

#include <kte/dynamics/contacts/implicit_forces.hpp>
#include <kte/kernels/joint_vector.hpp>

#include <cmath>

/// Derivatives of the forces of a control law.
namespace kte::detail {

/// A model under a control law, or a model.
template <class F>
decltype(auto) model_in(const F& f) {
  if constexpr (requires { f.model(); })
    return f.model();
  else
    return (f);
}
/// The state of the model, of a state with those of a law.
template <class F, class X>
decltype(auto) state_of_model(const F& f, const X& x) {
  if constexpr (requires { f.own_part(x); })
    return f.own_part(x);
  else
    return (x);
}
/// Whether the inputs of a model follow a law.
template <class F, class X>
concept has_law = requires(F& f, const X& x) {
  f.set_inputs(0.0, x);
};

/// K = -df/dq and D = -df/dv of the forces that elements between coordinates have by the inputs of a law u(t, x), by
/// differences, for coordinates that are numbers.
template <class X>
class law_slopes {
 public:
  /// The derivatives at x, where the inputs are those of the law; nullptr if they are zero. `stepper`: a
  /// `contact_stepper` of the model.
  template <class F, class Stepper>
  const force_slopes* find(F& f, Stepper& stepper, double t, const X& x) {
    const auto& model = model_in(f);
    if constexpr (requires { f.follows_state(); })
      if (!f.follows_state()) return nullptr;
    const Eigen::Index n = model.velocity_count(), at_v = model.state_size() - n - model.internals();
    bool some = false;
    slopes_.by_q.setZero(n, n), slopes_.by_v.setZero(n, n);
    inputs_ = model.input(), moved_ = x;
    stepper.input_forces(model, t, state_of_model(f, x), forces_);
    const auto vary = [&](Eigen::Index place, Eigen::MatrixXd& by, Eigen::Index column) {
      const double there = moved_[place], step = 1e-7 * (1 + std::abs(there));
      moved_[place] += step, f.set_inputs(t, moved_), moved_[place] = there;
      if (model.input() == inputs_) return;
      stepper.input_forces(model, t, state_of_model(f, x), varied_);
      by.col(column) = (forces_ - varied_) / step;
      some = true;
    };
    for (const auto& freedom : model.freedoms()) {
      if (freedom.what != kind::gen) continue;
      vary(freedom.q, slopes_.by_q, freedom.v), vary(at_v + freedom.v, slopes_.by_v, freedom.v);
    }
    f.set_inputs(t, x);
    return some ? &slopes_ : nullptr;
  }

 private:
  force_slopes slopes_;
  Eigen::VectorXd inputs_, forces_, varied_;
  X moved_;
};

}  // namespace kte::detail
