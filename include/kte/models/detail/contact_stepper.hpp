#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/static_chains.hpp>
#include <kte/dynamics/contacts/velocity_step.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#include <optional>

/// The velocities after a step of a model with contacts, with the memory for it.
namespace kte::detail {

template <>
class contact_stepper<manipulator_dynamics_model<runtime_chain>> {
  using model_type = manipulator_dynamics_model<runtime_chain>;

 public:
  explicit contact_stepper(const model_type& m) : s_(m.make_state()) {}
  /// From the state x at the time t.
  template <class X>
  const Eigen::VectorXd& velocities(const model_type& m, double t, const X& x, double h) {
    m.setJointStates(t, x, s_), check_positions(s_), check_regular_tree(m, s_);
    v_ = m.velocities_of(x);
    step_velocities(contacts_of(m.chain()), s_, contact_memory(m.chain(), s_), h, v_);
    check_result(s_, diagnose_state{"a velocity", s_});
    return v_;
  }
  template <class Name>
  const contact_state<>& contact(const Name& name) const {
    return s_.contact(name);
  }

 private:
  runtime_state s_;
  Eigen::VectorXd v_;
};

template <class Gravity, class... E, class Output>
class contact_stepper<manipulator_dynamics_model<static_chain<Gravity, E...>, double, Output>> {
  using chain_type = static_chain<Gravity, E...>;
  using wiring = typename chain_type::wiring;

 public:
  template <class Model>
  explicit contact_stepper(const Model& m) : s_(m.chain()) {}
  template <class Model, class X>
  const Eigen::VectorXd& velocities(const Model& m, double t, const X& x, double h) {
    const double *q = x.data(), *v = q + wiring::nq;
    const configuration<double, wiring, const double*> at(q);
    at.check();
    const auto bases = m.bases_at(t, v + wiring::dofs);
    bases.check();
    const given g{at, each<double, const double*>{v}, same<zero_t>{}, bases};
    s_.take(g), check_regular(m.chain(), s_);
    v_ = m.velocities_of(x);
    step_velocities(static_contacts<chain_type, std::remove_const_t<decltype(g)>>{{{m.chain(), g}}}, s_, s_.contacts, h,
                    v_);
    check_accelerations<wiring>(joint_vector<double, chain_type::dofs>(v_), g,
                                joint_vector<double, chain_type::dofs>::Zero().eval());
    return v_;
  }
  template <key_type Key>
  const contact_state<>& contact(const Key&) const {
    return s_.template get<kind::contact>(static_cast<int>(slot_of_contact<chain_type, Key>));
  }

 private:
  static_contact_state<chain_type> s_;
  Eigen::VectorXd v_;
};

}  // namespace kte::detail
