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

#include <functional>

namespace kte {

namespace detail {
struct runtime_model_contacts;
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
  /// valid until the next call. `event_of`: the contact whose event it is, at a state of an integrator; -1: a start.
  std::string_view resolve_contacts(double t, state& x, int event_of = -1) const;
  /// The length of the chain to which tolerances of contacts are relative, m.
  [[nodiscard]] double contact_length() const;
  /// The absolute tolerance of an integrator for velocities, m/s: slow sliding in space is not resolved more finely
  /// (dynamics/contacts/slow_sliding.hpp). 1e-9 of the length of the chain per second at first.
  void let_contacts_tolerate(double of_velocity) const;
  /// Moves x by a few velocity steps over a time where no modes are found; returns the time after. `before`: bridges
  /// that this one follows.
  double bridge_contacts(double t, state& x, double t_end, int before) const;
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
  /// The time of the next calls of `begin_step`, `settle`, `make_x` and `on_loops`, 0 at first: the surfaces of
  /// contacts, and joints in loops, may move by signals. Integrators call it.
  void settle_at(double t) const;
  /// Declares that the inputs are functions of time: the caller sets them before each evaluation, `begin_step` and
  /// `settle`. Joints in loops may then move by them; otherwise inputs are constant in a step, and velocities that they
  /// give to such joints are refused.
  void let_inputs_move() { inputs_move_ = true; }
  /// Whether the inputs are functions of time.
  [[nodiscard]] bool inputs_move() const { return inputs_move_; }
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
  detail::runtime_model_contacts contacts_of_model() const;
  /// The accelerations of a chain with loops at the model's state.
  const Eigen::VectorXd& accelerations_in_step() const;

  // Working memory, also through std::cref: use one model per thread.
  mutable runtime_state s_;
  mutable rate rate_;
  mutable detail::own_memory step_;  ///< the rows of closures and contacts of a step
  std::vector<detail::lock_place> locks_;
  output_function output_;
  bool inputs_move_ = false;
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
  template <class Bounds>
  void tolerate(const Bounds& bounds) const {
    if (contact >= 0) let_contacts_tolerate(*model, bounds);
  }
  /// For bridges: the time that many steps must bring, s; 0: none.
  double patience() const { return contact < 0 ? 0 : patience_with_contacts(model->contact_length()); }
  double bridge(double t, Eigen::VectorXd& x, double t_end, int before) const;
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
    if (elements[i].touches) {
      const int contact = elements[i].index.back();
      for (int part = 0; part < detail::parts_of_contact(elements[i].element->rows()); ++part)
        all.push_back(detail::contact_event(model, detail::runtime_switching{&model, i, contact, part}));
    } else if (elements[i].element->switches()) {
      all.push_back(event(detail::runtime_switching{&model, i})
                        .reset(reset{{&model, i}})
                        .may_repeat(detail::repeats_of_elements));
    }
  }
  return events(std::move(all));
}

}  // namespace kte

#ifdef KTE_FUNCTION
#  include <kte/models/detail/runtime_model_functions.hpp>
#endif
