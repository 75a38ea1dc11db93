#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/jacobian.hpp>
#include <kte/dynamics/state_vectors.hpp>
#include <kte/events/events.hpp>
#include <kte/models/detail/runtime_momenta.hpp>
#include <kte/models/detail/runtime_rate_derivatives.hpp>
#include <kte/models/element_events.hpp>
#include <kte/models/manipulator_dynamics_model.hpp>
#include <kte/models/unchanging_chain.hpp>
#include <kte/runtime_chain.hpp>

#ifdef KTE_FUNCTION
#  include <kte/models/detail/contact_events.hpp>
#  include <kte/models/detail/loop_steps.hpp>
#  include <kte/models/detail/runtime_model_contacts.hpp>
#endif

#include <functional>

namespace kte {

namespace detail {
template <>
struct sizes_of_model<unchanging_chain> {
  static constexpr int q = Eigen::Dynamic, v = q, z = q, u = q, x = q, x_dot = q;
  static constexpr bool only_numbers = false;
  static std::span<const freedom> freedoms(const runtime_chain& c) { return c.wiring().free; }
  static int nq(const runtime_chain& c) { return c.nq(); }
  static int nv(const runtime_chain& c) { return c.dofs(); }
  static int nu(const runtime_chain& c) { return c.wiring().nu; }
  static int count(const runtime_chain& c, kind k) {
    return static_cast<int>(c.wiring().names[static_cast<std::size_t>(k)].size());
  }
  template <class Visit>
  static void each_input(const runtime_chain& c, const Visit& visit) {
    for (const auto& s : c.wiring().signals)
      if (s.u >= 0)
        visit(c.wiring().names[static_cast<std::size_t>(s.what)][static_cast<std::size_t>(s.slot)], s.u, nu_of(s.what));
  }
};
}  // namespace detail

/// The dynamics of a runtime chain as a system x' = f(t, x, u), y = h(t, x, u): see `manipulator_dynamics_model`.
template <>
class manipulator_dynamics_model<runtime_chain, double, void> : public state_space<unchanging_chain, double> {
  using base = state_space<unchanging_chain, double>;

 public:
  using output_function = std::function<Eigen::VectorXd(const runtime_state&)>;

  /// A model of a runtime chain. Throws `bad_wiring` like `runtime_chain::make_state`, and if an element locks a
  /// coordinate that others move.
  explicit manipulator_dynamics_model(const runtime_chain& c);

  const rate& computeStateRate(double t, const state& x) const;
  /// x' of (1), for integrators. If it throws, integrators try a shorter step, or report the time and the cause.
  const rate& operator()(double t, const state& x) const { return computeStateRate(t, x); }

  /// The derivatives of x' by displacements from x. `jacobian` returns whether they are available: for chains without
  /// internal states whose joints are described by their `relative` (tree/chain_tree.hpp); otherwise stiff methods use
  /// differences.
  using jacobian_matrix = Eigen::MatrixXd;
  bool jacobian(double t, const state& x, jacobian_matrix& j) const;
  /// The Jacobian of x'; throws `bad_argument` if it is not available.
  jacobian_matrix jacobian(double t, const state& x) const;

  /// (J B): `jacobian` and the derivatives of x' by inputs, also with internal states. Throws `bad_argument` for a
  /// joint that only passes support.
  template <std::same_as<double> T>
  [[nodiscard]] jacobian_matrix jacobian_with_inputs(const T& t, const state& x) const {
    setJointStates(t, x, s_);
    jacobian_matrix j;
    detail::derive_rates_by_inputs(chain(), s_, j);
    return j;
  }

  using base::make_x;
  /// The state x of vectors q and v, with z = 0 (of elements that start in place that of q) or as given.
  [[nodiscard]] state make_x(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;
  [[nodiscard]] state make_x(const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& z) const;
  using base::setInput;
  /// Sets all inputs u. Throws `bad_argument` for a wrong number of inputs, and for numbers that are not finite.
  void setInput(const Eigen::VectorXd& u);
  using base::input;
  /// The value of an input. Throws `unknown_name`, and `bad_argument` for a signal that an element writes, and for the
  /// time.
  double& input(std::string_view name) { return u_[place_of_input(name, kind::input)]; }
  /// An input of three numbers.
  Eigen::Ref<Eigen::Vector3d> vector(std::string_view name) {
    return u_.segment<3>(place_of_input(name, kind::vector));
  }

  /// The state x of a state of the chain.
  [[nodiscard]] state getJointStates(const runtime_state& s) const;
  /// Stores the time, x and the inputs in a state of the chain. Frames are updated by the next doMotion.
  void setJointStates(double t, const state& x, runtime_state& s) const;
  /// Stores x and the inputs in a state of the chain; the time is unchanged.
  void setJointStates(const state& x, runtime_state& s) const;
  /// The state of the chain at x, with all its frames, accelerations and forces; valid until the next call.
  const runtime_state& state_at(double t, const state& x) const { return own_state_at(t, x); }

  [[nodiscard]] Eigen::VectorXd computeOutput(double t, const state& x) const;
  /// The function that goes through zero where the law of element number `which` of the chain changes; 1 if it does
  /// not. For events: `element_events(model)`.
  [[nodiscard]] double switching(double t, const state& x, std::size_t which) const;
  /// Updates the mode of the element after its law has changed.
  void switch_over(double t, state& x, std::size_t which) const;
  /// Makes the mode of the element consistent with the state, for the start of an integration. Returns whether it has
  /// changed.
  bool mend(double t, state& x, std::size_t which) const;

  /// The generalized forces M a at x, N and Nm: those of gravity, elements and inputs, minus Coriolis and centrifugal
  /// forces.
  [[nodiscard]] Eigen::VectorXd forces_at(const state& x, double t = 0) const;

  // ---- elements that may lock a coordinate: models/modes.hpp
  [[nodiscard]] const std::vector<detail::lock_place>& locks() const { return locks_; }
  const Eigen::VectorXd& needed_forces(double t, const state& x) const;
  [[nodiscard]] double capacity(double t, const state& x, std::size_t element) const;

  // ---- contacts, by number: models/detail/contact_events.hpp
  /// The function of a contact that passes through zero where its mode changes; `part` 0: its gap or normal force, 1:
  /// friction or velocity of sliding, 2: sense of sliding in space.
  [[nodiscard]] double contact_margin(double t, const state& x, int contact, int part) const;
  /// Resolves impacts, finds the modes of all contacts, and puts x on the rows of closed ones. Returns what changed,
  /// valid until the next call. `along_solution`: x is a state of an integrator with the present modes.
  std::string_view resolve_contacts(double t, state& x, bool along_solution = false) const;
  /// What the last `resolve_contacts` has changed.
  [[nodiscard]] std::string_view contact_change() const;

  /// Whether the output is a function of `with_output`, not (q, v).
  [[nodiscard]] bool has_output() const { return static_cast<bool>(output_); }
  /// The system with another output, a function of a state of the chain.
  [[nodiscard]] manipulator_dynamics_model with_output(output_function f) const {
    auto m = *this;
    m.output_ = std::move(f);
    return m;
  }

  // ---- motion on the group, as in `state_space`
  /// out = x (+) d (integrators/motion_space.hpp).
  void displace(const state& x, const rate& d, state& out) const;
  /// Converts the rate r of the state to that of the displacement d.
  void pull_back(const rate& d, rate& r) const;
  /// The size of the state for each number of a displacement.
  void magnitudes(const state& x, rate& m) const;
  /// The part of d lost in the rounding of out.
  void rounding(const state& x, const rate& d, const state& out, rate& rest) const;

  // ---- chains with loops (integrators/motion_space.hpp); no effect for other chains
  /// Whether the chain has closures of loops.
  [[nodiscard]] bool has_loops() const { return detail::has_loops(chain()); }
  /// Projects the positions and velocities of x = x0 (+) d onto the loops, by the least change in kinetic energy, and
  /// updates d. Throws `bad_argument`, naming the closure that does not close.
  void settle(const state& x0, rate& d, state& x) const;
  /// The time of the next calls of `begin_step` and `settle`: the surfaces of contacts may move.
  void settle_at(double t) const;
  /// Removes from a displacement from x0 the part that `settle` would remove.
  void tangential(const state& x0, rate& e) const;
  /// Chooses the independent rows of closures for the step from x0. Throws `bad_argument` if x0 is off the loops.
  void begin_step(const state& x0) const;
  /// Throws `bad_argument` where the step from x0 that has just been computed ends too near to a singular
  /// configuration.
  void check_end(const state& x0, const state& next) const;
  /// The relative distance of x0, where a step begins, from singular configurations of the loops; 1 without loops.
  [[nodiscard]] double singular_distance(const state& x0) const;
  /// Projects any x onto the loops. Throws `bad_argument`, naming a closure that does not close from there; `assemble`
  /// can close loops from farther away.
  [[nodiscard]] state on_loops(const state& x) const;

 private:
  int place_of_input(std::string_view name, kind k) const;
  /// doMotion of the elements with internal states, and of those on which they depend.
  void rates_of_internals() const;
  runtime_state& own_state_at(double t, const state& x) const;
  auto contacts_of_model() const;
  /// The accelerations of a chain with loops at the model's state.
  const Eigen::VectorXd& accelerations_in_step() const;

  // Working memory, also through std::cref: use one model per thread.
  mutable runtime_state s_;
  mutable rate rate_;
  mutable detail::own_memory step_;  ///< the rows of closures and contacts of a step
  std::vector<detail::lock_place> locks_;
  output_function output_;
};
manipulator_dynamics_model(const runtime_chain&)->manipulator_dynamics_model<runtime_chain>;

namespace detail {
/// `switching` of one element of a runtime chain, with its reset; or of a contact, one of its functions.
struct runtime_switching {
  const manipulator_dynamics_model<runtime_chain>* model;
  std::size_t element;
  int contact = -1, part = 0;

  double operator()(double t, const Eigen::VectorXd& x) const;
  /// The reset: switches the mode of the element.
  void switch_over(double t, Eigen::VectorXd& x) const;
  /// At the start of an integration: makes the mode of the element consistent.
  bool mend(double t, Eigen::VectorXd& x) const;
  /// The size of the state without the states of a law.
  Eigen::Index own() const { return model->nq() + model->dofs() + model->internals(); }
  std::string name() const;
  /// What the last event of a contact has changed.
  std::string_view what() const { return contact < 0 ? std::string_view() : model->contact_change(); }
};
}  // namespace detail

/// The events of the elements of a runtime chain whose laws change; see models/element_events.hpp.
[[nodiscard]] inline auto element_events(const manipulator_dynamics_model<runtime_chain>& model) {
  using reset = detail::switch_element<detail::runtime_switching>;
  std::vector<decltype(event(detail::runtime_switching{}).reset(reset{}))> all;
  const auto& elements = model.wiring().elements;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto add = [&](crossing way, const detail::runtime_switching& f) {
      all.push_back(event(f, way).reset(reset{f}));
    };
    if (elements[i].touches) {
      const int contact = elements[i].index.back();
      for (int part = 0; part < detail::parts_of_contact(elements[i].element->rows()); ++part)
        add(crossing::falling, {&model, i, contact, part});
    } else if (elements[i].element->switches()) {
      add(crossing::both, {&model, i});
    }
  }
  return events(std::move(all));
}

}  // namespace kte

#ifdef KTE_FUNCTION
namespace kte {

KTE_FUNCTION manipulator_dynamics_model<runtime_chain>::manipulator_dynamics_model(const runtime_chain& c)
    : base(c), s_(c.make_state()), rate_(rate::Zero(rates())) {
  if (detail::has_loops(c)) detail::check_loops(detail::closures_of(c), s_);
  for (const int e : s_.tree().locks) {
    const auto& index = wiring().elements[static_cast<std::size_t>(e)].index;
    const int row = s_.tree().plan.row_of_gen[static_cast<std::size_t>(index[0])];
    if (row >= dofs())
      throw bad_wiring("kte: " + describe_element(*wiring().elements[static_cast<std::size_t>(e)].element) +
                       " holds a coordinate that is not a degree of freedom");
    locks_.push_back({static_cast<std::size_t>(e), row, nq() + row, nq() + dofs() + index[1]});
  }
}

inline auto manipulator_dynamics_model<runtime_chain>::contacts_of_model() const {
  return detail::runtime_model_contacts<manipulator_dynamics_model>{*this, s_, step_};
}
KTE_FUNCTION double manipulator_dynamics_model<runtime_chain>::contact_margin(double t, const state& x, int contact,
                                                                              int part) const {
  return detail::contact_margins(contacts_of_model(), t,
                                 x)[static_cast<std::size_t>(contact)][static_cast<std::size_t>(part)];
}
KTE_FUNCTION std::string_view manipulator_dynamics_model<runtime_chain>::resolve_contacts(double t, state& x,
                                                                                          bool along_solution) const {
  detail::resolve_contacts(contacts_of_model(), t, x, along_solution);
  return contact_change();
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
  const auto& a = detail::constrained_accelerations(chain(), s_, detail::no_forces{}, detail::rows_of_stage(loops));
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
  if (detail::has_contacts(chain())) contacts_of_model().memory().time = t;
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
    (void)model->resolve_contacts(t, part_of_model, true);
  x.head(own()) = part_of_model;
}
KTE_FUNCTION bool runtime_switching::mend(double t, Eigen::VectorXd& x) const {
  Eigen::VectorXd part_of_model = x.head(own());
  const bool was_wrong = contact < 0 ? model->mend(t, part_of_model, element) : mend_contacts(*model, t, part_of_model);
  x.head(own()) = part_of_model;
  return was_wrong;
}
KTE_FUNCTION std::string runtime_switching::name() const {
  const auto& w = model->wiring();
  if (contact >= 0) return w.names[static_cast<std::size_t>(kind::contact)][static_cast<std::size_t>(contact)];
  return describe_element(*w.elements[element].element);
}
}  // namespace detail

}  // namespace kte
#endif
