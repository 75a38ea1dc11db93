#pragma once

#include <kte/dynamics/contacts/contact_dynamics.hpp>
#include <kte/dynamics/contacts/starting_depth.hpp>
#include <kte/dynamics/contacts/static_chains.hpp>
#include <kte/dynamics/contacts/velocity_step.hpp>
#include <kte/models/detail/static_model_at_run_time.hpp>
#include <kte/models/detail/stepped_gates.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

/// Steps of a model with contacts, with the memory for them. A `contact_stepper` of a model m has
///
///   check_depth(m, t, x, depth)          throws `bad_argument` for a contact that is deeper than that
///   first(m, t, x, h, law, v)            the velocities after a step from v, with forces at x
///   again(m, t, x, h, v)                 the same from v before `first`, with forces at other velocities of x
///   strikes(m)                           whether a contact touches in `first` that did not in the step before
///   internal_rates(m, t, x, z_dot)
///   input_forces(m, t, x, f)             the forces of elements between coordinates, by rows of v
///   contact(name)                        the contact in the last step
///   state_at(m, t, x, a)                 a state of the chain at x, with accelerations a and the contacts of the last
///                                        step
namespace kte::detail {

/// The forces of elements between coordinates.
inline void forces_between_coordinates(const runtime_elements& c, runtime_state& s, Eigen::VectorXd& f) {
  clear_coordinates(s);
  for (auto e = s.tree().on_coordinates.rbegin(); e != s.tree().on_coordinates.rend(); ++e) c.push(*e, s);
  f.resize(s.dofs()), read_listed_numbers<vector_of::f>(s, f);
}

template <>
class contact_stepper<manipulator_dynamics_model<runtime_chain>> {
  using model_type = manipulator_dynamics_model<runtime_chain>;

 public:
  explicit contact_stepper(const model_type& m) : s_(m.make_state()) {}

  template <class X>
  void check_depth(const model_type& m, double t, const X& x, double depth) {
    m.setJointStates(t, x, s_), check_positions(s_), check_regular_tree(m, s_);
    check_starting_depth(contacts_of(m.chain()), s_, contact_memory(m.chain(), s_), depth,
                         [&](int e) { return admits_contact(m, t, x, e); });
  }
  template <class X>
  void first(const model_type& m, double t, const X& x, double h, const force_slopes* law, Eigen::VectorXd& v) {
    m.setJointStates(t, x, s_), check_positions(s_), check_regular_tree(m, s_);
    step_.first(contacts_of(m.chain()), s_, contact_memory(m.chain(), s_), h, law, gates_.at(m, t, x), v);
    check_result(s_, diagnose_state{"an acceleration", s_});
  }
  template <class X>
  void again(const model_type& m, double t, const X& x, double h, Eigen::VectorXd& v) {
    m.setJointStates(t, x, s_);
    step_.again(contacts_of(m.chain()), s_, contact_memory(m.chain(), s_), h, v);
    check_result(s_, diagnose_state{"an acceleration", s_});
  }
  bool strikes(const model_type& m) { return step_.strikes(contact_memory(m.chain(), s_)); }
  template <class X>
  void internal_rates(const model_type& m, double t, const X& x, double* z_dot) {
    m.setJointStates(t, x, s_);
    for (const int keeper : m.wiring().keepers) move_element(m.wiring(), s_, keeper);
    for (int i = 0; i < m.wiring().count(kind::internal); ++i) z_dot[i] = s_.get<kind::internal>(i).z_dot;
  }
  template <class X>
  void input_forces(const model_type& m, double t, const X& x, Eigen::VectorXd& f) {
    m.setJointStates(t, x, s_);
    forces_between_coordinates(runtime_elements{m.chain()}, s_, f);
  }
  template <class Name>
  const contact_state<>& contact(const Name& name) const {
    return s_.contact(name);
  }
  /// The state of the last step.
  const runtime_state& state() const { return s_; }
  template <class X, class A>
  const runtime_state& state_at(const model_type& m, double t, const X& x, const A& a) {
    m.setJointStates(t, x, s_), set_accelerations(s_, a);
    m.doMotion(s_), m.clearForce(s_), m.doForce(s_);
    return s_;
  }

 private:
  runtime_state s_;
  velocity_step step_;
  stepped_gates gates_;
};

template <class Gravity, class... E, class Output>
class contact_stepper<manipulator_dynamics_model<static_chain<Gravity, E...>, double, Output>> {
  using chain_type = static_chain<Gravity, E...>;

 public:
  template <class Model>
  explicit contact_stepper(const Model& m) : model_(model_at_run_time(m)), stepper_(model_) {}

  template <class Model, class X>
  void check_depth(const Model& m, double t, const X& x, double depth) {
    stepper_.check_depth(of(m), t, at(x), depth);
  }
  template <class Model, class X>
  void first(const Model& m, double t, const X& x, double h, const force_slopes* law, Eigen::VectorXd& v) {
    stepper_.first(of(m), t, at(x), h, law, v);
  }
  template <class Model, class X>
  void again(const Model& m, double t, const X& x, double h, Eigen::VectorXd& v) {
    stepper_.again(of(m), t, at(x), h, v);
  }
  template <class Model>
  bool strikes(const Model&) {
    return stepper_.strikes(model_);
  }
  template <class Model, class X>
  void internal_rates(const Model& m, double t, const X& x, double* z_dot) {
    stepper_.internal_rates(of(m), t, at(x), z_dot);
  }
  template <class Model, class X>
  void input_forces(const Model& m, double t, const X& x, Eigen::VectorXd& f) {
    stepper_.input_forces(of(m), t, at(x), f);
  }
  template <key_type Key>
  const contact_state<>& contact(const Key&) const {
    return stepper_.state().template get<kind::contact>(static_cast<int>(slot_of_contact<chain_type, Key>));
  }
  template <class Model, class X, class A>
  auto state_at(const Model& m, double t, const X& x, const A& a) const {
    auto s = make_state(m.chain());
    m.setJointStates(t, x, s), set_accelerations(s, a.data());
    static_model_at_run_time<chain_type>::put_constraints(stepper_.state(), s);
    m.doMotion(s), m.clearForce(s), m.doForce(s);
    return s;
  }

 private:
  template <class Model>
  const manipulator_dynamics_model<runtime_chain>& of(const Model& m) {
    if constexpr (chain_type::wiring::nu > 0) model_.setInput(m.input());
    return model_;
  }
  template <class X>
  const Eigen::VectorXd& at(const X& x) {
    return x_ = x;
  }
  manipulator_dynamics_model<runtime_chain> model_;
  contact_stepper<manipulator_dynamics_model<runtime_chain>> stepper_;
  Eigen::VectorXd x_;
};

}  // namespace kte::detail
