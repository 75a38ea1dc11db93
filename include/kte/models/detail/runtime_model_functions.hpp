#pragma once

#include <kte/models/detail/contact_events.hpp>
#include <kte/models/detail/loop_steps.hpp>
#include <kte/models/detail/runtime_model_contacts.hpp>
#include <kte/models/runtime_dynamics_model.hpp>

#ifdef KTE_FUNCTION
/// The functions of models of runtime chains, compiled once (kte/detail/compiled.hpp).
namespace kte {

KTE_FUNCTION manipulator_dynamics_model<runtime_chain>::manipulator_dynamics_model(const runtime_chain& c)
    : base(c), s_(c.make_state()), rate_(rate::Zero(rates())) {
  if (detail::has_loops(c))
    detail::check_model_of_loops(detail::closures_of(c), s_, detail::loops_of(c, s_).equations.places,
                                 detail::has_contacts(c));
  for (const int e : s_.tree().locks) {
    const auto& index = wiring().elements[static_cast<std::size_t>(e)].index;
    const int row = s_.tree().plan.row_of_gen[static_cast<std::size_t>(index[0])];
    if (row >= dofs())
      throw bad_wiring("kte: " + describe_element(*wiring().elements[static_cast<std::size_t>(e)].element) +
                       " holds a coordinate that is not a degree of freedom");
    locks_.push_back({static_cast<std::size_t>(e), row, nq() + row, nq() + dofs() + index[1]});
  }
}

inline detail::runtime_model_contacts manipulator_dynamics_model<runtime_chain>::contacts_of_model() const {
  return detail::runtime_model_contacts{*this, s_, step_};
}
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::contact_margin(double t, const state& x, int contact,
                                                                              int part) const {
  return detail::contact_margins(contacts_of_model(), t, x)[static_cast<std::size_t>(contact)].at(part);
}
KTE_FUNCTION std::string_view manipulator_dynamics_model<runtime_chain>::resolve_contacts(double t, state& x,
                                                                                          int event_of) const {
  detail::resolve_contacts(contacts_of_model(), t, x, event_of);
  return contact_change();
}
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::contact_length() const {
  return contacts_of_model().memory().at.equations.places.length;
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::let_contacts_tolerate(double of_velocity) const {
  contacts_of_model().memory().let_tolerate(of_velocity);
}
KTE_FUNCTION std::string_view manipulator_dynamics_model<runtime_chain>::contact_change() const {
  return contacts_of_model().memory().change;
}
KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::computeStateRate(double t, const state& x) const
    -> const rate& {
  setJointStates(t, x, s_);
  rate_.head(dofs()) = velocities_of(x);
  if (detail::has_contacts(chain()))
    rate_.segment(dofs(), dofs()) = detail::accelerate_with_contacts_in_step(contacts_of_model(), t, x);
  else if (detail::has_loops(chain()))
    rate_.segment(dofs(), dofs()) = accelerations_in_step();
  else
    rate_.segment(dofs(), dofs()) = forward_dynamics(chain(), s_);
  rates_of_internals();
  return rate_;
}
KTE_FUNCTION const Eigen::VectorXd& manipulator_dynamics_model<runtime_chain>::accelerations_in_step() const {
  detail::check_regular_tree(chain(), s_), detail::check_positions(s_);
  const detail::runtime_model_loops loops{*this, s_, step_};
  const auto& a =
      detail::constrained_accelerations(chain(), s_, tree::given_forces<double>{}, detail::rows_of_stage(loops));
  detail::note_stage(loops);
  return a;
}
KTE_FUNCTION bool manipulator_dynamics_model<runtime_chain>::jacobian(double t, const state& x,
                                                                      jacobian_matrix& j) const {
  if (internals() > 0 || s_.tree().irregular || has_loops()) return false;
  setJointStates(t, x, s_);
  const auto& of_accelerations = forward_dynamics_derivatives(chain(), s_);
  j.resize(rates(), rates());
  const Eigen::VectorXd v = velocities_of(x);
  detail::put_rate_derivatives(freedoms(), v, of_accelerations, j);
  return true;
}
KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::jacobian(double t, const state& x) const
    -> jacobian_matrix {
  jacobian_matrix j;
  if (!jacobian(t, x, j))
    throw bad_argument(
        "kte: the Jacobian of a model of a runtime chain is known where it has no internal states, and joints that "
        "move by their `relative` alone");
  return j;
}

KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::make_x(const Eigen::VectorXd& q,
                                                                    const Eigen::VectorXd& v) const -> state {
  state x = base::make_x(q, v);
  for (const int keeper : wiring().keepers)
    if (wiring().elements[static_cast<std::size_t>(keeper)].starts_in_place)
      switch_over(0, x, static_cast<std::size_t>(keeper));
  return detail::has_contacts(chain()) ? x : detail::checked_on_loops(*this, x);
}
KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::make_x(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                                    const Eigen::VectorXd& z) const -> state {
  const state x = base::make_x(q, v, z);
  return detail::has_contacts(chain()) ? x : detail::checked_on_loops(*this, x);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::setInput(const Eigen::VectorXd& u) { base::setInput(u); }
KTE_FUNCTION int manipulator_dynamics_model<runtime_chain>::place_of_input(std::string_view name, kind k) const {
  const int slot = wiring().find(name, k);
  for (const auto& signal : wiring().signals)
    if (signal.what == k && signal.slot == slot && signal.u >= 0) return signal.u;
  throw bad_argument("kte: '" + std::string(name) + "' is not an input: an element writes it, or it is the time");
}

KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::getJointStates(const runtime_state& s) const -> state {
  check(s);
  Eigen::VectorXd z(internals());
  for (int i = 0; i < own_internals(); ++i) z[i] = s.get<kind::internal>(i).z;
  each_contact([&](int i, int first) { detail::put_mode(s.get<kind::contact>(i), first - nq() - dofs(), z); });
  return make_x(positions(s), velocities(s), z);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::setJointStates(double t, const state& x,
                                                                            runtime_state& s) const {
  setJointStates(x, s);
  for (const auto& signal : wiring().signals)
    if (signal.u < 0) s.get<kind::input>(signal.slot) = t;
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::setJointStates(const state& x, runtime_state& s) const {
  check(s), checked(x);
  set_positions(s, positions_of(x)), set_velocities(s, velocities_of(x));
  for (int i = 0; i < own_internals(); ++i) s.get<kind::internal>(i).z = x[nq() + dofs() + i];
  each_contact([&](int i, int first) { detail::read_mode(x, first, s.get<kind::contact>(i)); });
  for (const auto& signal : wiring().signals) {
    if (signal.what == kind::vector)
      s.get<kind::vector>(signal.slot) = {u_[signal.u], u_[signal.u + 1], u_[signal.u + 2]};
    else if (signal.u >= 0)
      s.get<kind::input>(signal.slot) = u_[signal.u];
  }
}
KTE_FUNCTION runtime_state& manipulator_dynamics_model<runtime_chain>::own_state_at(double t, const state& x) const {
  computeStateRate(t, x);  // sets the accelerations in the state
  doMotion(s_), clearForce(s_), doForce(s_);
  return s_;
}
KTE_FUNCTION Eigen::VectorXd manipulator_dynamics_model<runtime_chain>::computeOutput(double t, const state& x) const {
  checked(x);
  if (output_) return output_(state_at(t, x));
  return x.head(nq() + dofs());
}

KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::switching(double t, const state& x,
                                                                         std::size_t which) const {
  for (const auto& h : locks_)
    if (h.element == which) return detail::mode_function(*this, t, x, h);
  setJointStates(t, x, s_);
  doMotion(s_);
  return wiring().elements.at(which).element->switching(s_);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::switch_over(double t, state& x, std::size_t which) const {
  for (const auto& h : locks_)
    if (h.element == which) return detail::switch_mode(*this, t, x, h);
  setJointStates(t, x, s_);
  doMotion(s_);
  wiring().elements.at(which).element->switch_over(s_);
  for (int i = 0; i < own_internals(); ++i) x[nq() + dofs() + i] = s_.get<kind::internal>(i).z;
}
KTE_FUNCTION bool manipulator_dynamics_model<runtime_chain>::mend(double t, state& x, std::size_t which) const {
  for (const auto& h : locks_)
    if (h.element == which) return detail::mend_at_start(*this, t, x, h);
  state after = x;
  switch_over(t, after, which);
  return detail::mend_internals(after, x, nq() + dofs(), x.size());
}
KTE_FUNCTION Eigen::VectorXd manipulator_dynamics_model<runtime_chain>::forces_at(const state& x, double t) const {
  setJointStates(t, x, s_);
  return -nonlinear_effects(chain(), s_);
}
KTE_FUNCTION const Eigen::VectorXd& manipulator_dynamics_model<runtime_chain>::needed_forces(double t,
                                                                                             const state& x) const {
  computeStateRate(t, x);  // sets the accelerations in the state
  return inverse_dynamics(chain(), s_);
}
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::capacity(double t, const state& x,
                                                                        std::size_t element) const {
  const auto& e = wiring().elements.at(element);
  if (e.rigid) return e.element->capacity(own_state_at(t, x));
  setJointStates(t, x, s_);
  doMotion(s_);
  return e.element->capacity(s_);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::rates_of_internals() const {
  for (const int keeper : wiring().keepers) detail::move_element(wiring(), s_, keeper);
  for (int i = 0; i < own_internals(); ++i) rate_[2 * dofs() + i] = s_.get<kind::internal>(i).z_dot;
}

KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::displace(const state& x, const rate& d, state& out) const {
  base::displace(x, d, out);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::pull_back(const rate& d, rate& r) const {
  base::pull_back(d, r);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::magnitudes(const state& x, rate& m) const {
  base::magnitudes(x, m);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::rounding(const state& x, const rate& d, const state& out,
                                                                      rate& rest) const {
  base::rounding(x, d, out, rest);
}

KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::settle(const state& x0, rate& d, state& x) const {
  if (detail::has_contacts(chain())) return detail::settle_contacts(contacts_of_model(), x0, d, x);
  if (detail::has_loops(chain())) detail::settle_on_loops(detail::runtime_model_loops{*this, s_, step_}, x0, d, x);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::settle_at(double t) const {
  if (detail::has_contacts(chain()))
    contacts_of_model().memory().time = t;
  else if (detail::has_loops(chain()))
    detail::runtime_model_loops{*this, s_, step_}.step().time = t;
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::tangential(const state& x0, rate& e) const {
  if (detail::has_contacts(chain())) return detail::make_tangential_to_contacts(contacts_of_model(), x0, e);
  if (detail::has_loops(chain())) detail::make_tangential(detail::runtime_model_loops{*this, s_, step_}, x0, e);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::begin_step(const state& x0) const {
  if (detail::has_contacts(chain())) return detail::begin_step_with_contacts(contacts_of_model(), x0);
  if (detail::has_loops(chain())) detail::check_step(detail::runtime_model_loops{*this, s_, step_}, x0);
}
KTE_FUNCTION void manipulator_dynamics_model<runtime_chain>::check_end(const state& x0, const state&) const {
  if (detail::has_contacts(chain())) return;
  if (detail::has_loops(chain())) detail::check_step_end(detail::runtime_model_loops{*this, s_, step_}, x0);
}
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::singular_distance(const state& x0) const {
  if (detail::has_contacts(chain()) || !detail::has_loops(chain())) return 1;
  return detail::singular_distance_of(detail::runtime_model_loops{*this, s_, step_}, x0);
}
KTE_FUNCTION auto manipulator_dynamics_model<runtime_chain>::on_loops(const state& x) const -> state {
  state on = checked(x);
  rate d = rate::Zero(rates());
  settle(x, d, on);
  return on;
}

namespace detail {
KTE_FUNCTION double runtime_switching::operator()(double t, const Eigen::VectorXd& x) const {
  const auto value = [&](const Eigen::VectorXd& part_of_model) {
    return contact < 0 ? model->switching(t, part_of_model, element)
                       : model->contact_margin(t, part_of_model, contact, part);
  };
  return x.size() == own() ? value(x) : value(x.head(own()));
}
KTE_FUNCTION void runtime_switching::switch_over(double t, Eigen::VectorXd& x) const {
  Eigen::VectorXd part_of_model = x.head(own());
  if (contact < 0)
    model->switch_over(t, part_of_model, element);
  else
    (void)model->resolve_contacts(t, part_of_model, contact);
  x.head(own()) = part_of_model;
}
KTE_FUNCTION bool runtime_switching::mend(double t, Eigen::VectorXd& x) const {
  Eigen::VectorXd part_of_model = x.head(own());
  const bool was_wrong = contact < 0 ? model->mend(t, part_of_model, element) : mend_contacts(*model, t, part_of_model);
  x.head(own()) = part_of_model;
  return was_wrong;
}
KTE_FUNCTION double runtime_switching::bridge(double t, Eigen::VectorXd& x, double t_end, int before) const {
  Eigen::VectorXd part_of_model = x.head(own());
  const double after = model->bridge_contacts(t, part_of_model, t_end, before);
  x.head(own()) = part_of_model;
  return after;
}
KTE_FUNCTION std::string runtime_switching::name() const {
  const auto& w = model->wiring();
  if (contact >= 0) return w.names[static_cast<std::size_t>(kind::contact)][static_cast<std::size_t>(contact)];
  return describe_element(*w.elements[element].element);
}
}  // namespace detail

}  // namespace kte

#  include <kte/models/moreau_jean.hpp>
#endif
