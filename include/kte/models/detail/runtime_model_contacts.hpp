#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/models/detail/contact_step.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

namespace kte::detail {

/// Takes over from the state which contacts pass through their surface.
inline void take_passing(const runtime_state& s, contact_solver& m) {
  for (auto& x : m.contacts) x.passes = s.get<kind::contact>(x.slot).mode == passing_mode;
}
/// The contacts, and closures, of a model, with the model's memory.
struct runtime_model_contacts {
  const manipulator_dynamics_model<runtime_chain>& model;
  runtime_state& s;
  own_memory& kept;

  contact_step& memory() const {
    auto& step = kept.get<contact_step>([this] { return contact_step(contacts_of(model.chain()), s); });
    step.take_inputs(model.input());
    return step;
  }
  int contacts() const { return model.chain().wiring().count(kind::contact); }
  Eigen::VectorXd no_displacement() const { return Eigen::VectorXd::Zero(model.rates()); }
  /// Calls f(contacts, state at x, `contact_solver` of the state).
  template <class F>
  void at(double t, const Eigen::VectorXd& x, const F& f) const {
    model.setJointStates(t, x, s), check_positions(s), check_regular_tree(model.chain(), s);
    auto& m = contact_memory(model.chain(), s);
    take_passing(s, m);
    f(contacts_of(model.chain()), s, m);
  }
};

}  // namespace kte::detail
