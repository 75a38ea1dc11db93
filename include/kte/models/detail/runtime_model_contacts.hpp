#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/models/detail/contact_events.hpp>

namespace kte::detail {

/// The contacts, and closures, of a model of a runtime chain; see models/detail/contact_steps.hpp.
template <class Model>
struct runtime_model_contacts {
  const Model& model;
  runtime_state& s;
  own_memory& kept;

  contact_step& memory() const {
    auto& step = kept.get<contact_step>([this] { return contact_step(contacts_of(model.chain()), s); });
    step.take_inputs(model.input());
    return step;
  }
  int contacts() const { return model.chain().wiring().count(kind::contact); }
  auto no_displacement() const { return Model::rate::Zero(model.rates()).eval(); }
  template <class X>
  bool admits(double t, const X& x, int element) const {
    return admits_contact(model, t, x, element);
  }
  template <class X, class F>
  void at(double t, const X& x, const F& f) const {
    model.setJointStates(t, x, s), check_positions(s), check_regular_tree(model.chain(), s);
    auto& m = contact_memory(model.chain(), s);
    take_passing(s, m);
    f(contacts_of(model.chain()), s, m);
  }
};
/// The accelerations of a model with contacts at t and x, also in the state.
template <class Access, class X>
const Eigen::VectorXd& accelerate_with_contacts_in_step(const Access& a, double t, const X& x) {
  a.at(t, x, [&](const auto& c, runtime_state& s, contact_solver& m) {
    accelerate_in_step(a, c, s, m, x);
    check_result(s, diagnose_state{"an acceleration", s});
    write_numbers<vector_of::a>(s, s.work.forces, "a");
  });
  return a.s.work.forces;
}

}  // namespace kte::detail
