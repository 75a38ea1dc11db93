#pragma once

#include <kte/detail/no_value.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/models/detail/internal_rates.hpp>
#include <kte/models/detail/rate_derivatives.hpp>
#include <kte/models/modes.hpp>
#include <kte/models/state_rate_function.hpp>
#include <kte/models/state_space.hpp>

namespace kte {

/// A chain as a dynamic system:
///
///   x = (q, v, z)                          as in models/state_space.hpp
///   x' = (v, M(q)^-1 f(q, v, z, u), z')    by `forward_dynamics`, and `z_dot` of the elements         (1)
///   y = (q, v), or output(s)               of a state s of the chain at x
///
/// It derives from the chain, so that all algorithms apply, and it is a right-hand side for integrators:
///
///   kte::manipulator_dynamics_model arm(chain);
///   kte::dormand_prince45 solver(std::ref(arm), 0.0, arm.make_x(q, v));
///
/// For a static chain it is a value, without heap or virtual calls. For a runtime chain it owns a state, and results
/// are valid until the next call: use one model per thread. Bases are at rest, under the gravity of the chain.
template <class Chain, class S = double, class Output = void>
class manipulator_dynamics_model;

namespace detail {
class own_memory;
/// What a model of a static chain with closures or contacts keeps: models/detail/static_model_at_run_time.hpp, of
/// kte/loops.hpp and kte/contacts.hpp.
template <class Chain>
struct static_model_at_run_time;
/// Time stepping with contacts: models/detail/contact_stepper.hpp, of kte/contacts.hpp.
template <class Model>
class contact_stepper;
}  // namespace detail

/// The dynamics of a static chain as a system x' = f(t, x, u), y = h(t, x, u).
template <class Gravity, class... E, class S, class Output>
class manipulator_dynamics_model<static_chain<Gravity, E...>, S, Output>
    : public state_space<static_chain<Gravity, E...>, S> {
  using chain_type = static_chain<Gravity, E...>;
  using base = state_space<chain_type, S>;
  using size = detail::sizes_of_model<chain_type>;
  static constexpr bool touches = detail::has_contact_elements<chain_type>;
  static constexpr bool constrained = detail::has_closures<chain_type> || touches;

 public:
  using typename base::rate;
  using typename base::state;
  using typename chain_type::wiring;

  /// Throws `bad_argument` for a chain with closures whose model is not supported.
  explicit manipulator_dynamics_model(const chain_type& c) : base(c) { check_chain(); }

  using base::make_x;
  /// The state x of q and v, with z = 0; of elements that start in place that of q.
  template <indexable Q, indexable V>
  state make_x(const Q& q, const V& v) const {
    return started(base::make_x(q, v));
  }

  // ---- of chains with closures (integrators/motion_space.hpp)
  /// The state x of q and v, which is put on the loops. Throws `bad_argument` where it is off them.
  template <indexable Q, indexable V>
  state make_x(const Q& q, const V& v) const requires(constrained) {
    return at_run_time().checked(started(base::make_x(q, v)));
  }
  template <indexable Q, indexable V, indexable Z>
  state make_x(const Q& q, const V& v, const Z& z) const requires(constrained) {
    return at_run_time().checked(base::make_x(q, v, z));
  }
  static constexpr bool has_loops() requires(constrained) { return detail::has_closures<chain_type>; }
  /// The time of the next calls of `begin_step`, `settle`, `make_x` and `on_loops`, 0 at first: surfaces, and joints in
  /// loops, may move by signals. Integrators call it.
  void settle_at(const S& t) const requires(constrained) { at_run_time().model().settle_at(t); }
  /// To be called at the start of a step from x0: chooses the independent rows of closures. Throws `bad_argument` where
  /// x0 is off the loops.
  void begin_step(const state& x0) const requires(constrained) {
    const auto r = at_run_time();
    r.model().begin_step(r.at(x0));
  }
  /// Puts x = x0 (+) d on the loops by the least change in kinetic energy; d goes with it. Throws `bad_argument` that
  /// names the closure which does not close.
  void settle(const state& x0, rate& d, state& x) const requires(constrained) { at_run_time().settle(x0, d, x); }
  /// Takes out of a displacement from x0 what `settle` would.
  void tangential(const state& x0, rate& e) const requires(constrained) { at_run_time().tangential(x0, e); }
  /// Throws `bad_argument` where the step from x0 that has just been computed ends too near to a singular
  /// configuration.
  void check_end(const state& x0, const state&) const requires(constrained) {
    const auto r = at_run_time();
    r.model().check_end(r.at(x0), r.at(x0));
  }
  /// The relative distance of x0, where a step begins, from singular configurations of the loops.
  [[nodiscard]] double singular_distance(const state& x0) const requires(constrained) {
    const auto r = at_run_time();
    return r.model().singular_distance(r.at(x0));
  }
  /// x on the loops, wherever it is. Throws `bad_argument` that names a closure which does not close from there.
  state on_loops(const state& x) const requires(constrained) {
    state on = x;
    rate d = rate::Zero();
    settle(x, d, on);
    return on;
  }

  // ---- of chains with contacts (models/detail/contact_events.hpp)
  /// The function of a contact that passes through zero where its mode changes; `part` 0: its gap or normal force, 1:
  /// friction or velocity of sliding, 2: sense of sliding in space.
  [[nodiscard]] S contact_margin(const S& t, const state& x, int contact, int part) const requires(touches) {
    const auto r = at_run_time();
    return r.model().contact_margin(t, r.at(x), contact, part);
  }
  /// Resolves impacts, finds the modes of all contacts, and puts x on the rows of closed ones. Returns what changed,
  /// valid until the next call. `event_of`: the contact whose event it is, at a state of an integrator; -1: a start.
  std::string_view resolve_contacts(const S& t, state& x, int event_of = -1) const requires(touches) {
    return at_run_time().resolve_contacts(t, x, event_of);
  }
  /// The length of the chain to which tolerances of contacts are relative, m.
  [[nodiscard]] double contact_length() const requires(touches) { return at_run_time().model().contact_length(); }
  /// The absolute tolerance of an integrator for velocities, m/s: slow sliding in space is not resolved more finely
  /// (dynamics/contacts/slow_sliding.hpp). 1e-9 of the length of the chain per second at first.
  void let_contacts_tolerate(double of_velocity) const requires(touches) {
    at_run_time().model().let_contacts_tolerate(of_velocity);
  }
  /// Moves x by a few velocity steps over a time where no modes are found; returns the time after. `before`: bridges
  /// that this one follows.
  double bridge_contacts(const S& t, state& x, const S& t_end, int before) const requires(touches) {
    return at_run_time().bridge_contacts(t, x, t_end, before);
  }
  /// What the last `resolve_contacts` has changed.
  [[nodiscard]] std::string_view contact_change() const requires(touches) {
    return at_run_time().model().contact_change();
  }

  /// x' of (1). Throws `bad_argument` for numbers that are not finite, `singular_mass_matrix`.
  [[nodiscard]] rate computeStateRate(const S& t, const state& x) const {
    if constexpr (constrained) {
      static_assert(std::is_same_v<S, double>, "kte: closed loops and contacts are computed in double");
      const auto r = at_run_time();
      return r.model().computeStateRate(t, r.at(x));
    } else {
      const S *q = x.data(), *v = q + size::q, *z = v + size::v;
      const detail::configuration<S, wiring, const S*> at(q);
      const auto bases = bases_at(t, z);
      const joint_vector<S, size::v> none = joint_vector<S, size::v>::Zero();
      rate r;
      r.template head<size::v>() = this->velocities_of(x);
      r.template segment<size::v>(size::v) =
          detail::accelerations_under<S>(this->chain(), at, detail::each<S, const S*>{v}, bases, none);
      if constexpr (size::own_z > 0) detail::internal_rates(this->chain(), at, v, bases, &r[2 * size::v]);
      return r;
    }
  }
  /// x' of (1), for integrators. If it throws, integrators try a shorter step, or report the time and the cause.
  rate operator()(const S& t, const state& x) const { return computeStateRate(t, x); }
  /// x' of a vector of dynamic size, which is checked first; `state_at` and `computeOutput` likewise.
  template <class X>
  requires(X::SizeAtCompileTime == Eigen::Dynamic) rate operator()(const S& t, const Eigen::MatrixBase<X>& x) const {
    return computeStateRate(t, this->checked(x.derived()));
  }
  /// The Jacobian of x': derivatives by displacements from x, square of the size of x'
  /// (models/detail/rate_derivatives.hpp); without rotations J_ij = d x'_i / d x_j. Exact to rounding; inputs are as
  /// set. Stiff methods use it.
  using jacobian_matrix = Eigen::Matrix<S, size::x_dot, size::x_dot>;
  /// False for chains with both load-dependent friction and internal states, because the friction depends on
  /// accelerations, and so do these states. Stiff methods then use differences.
  static constexpr bool has_jacobian =
      !constrained && (size::z == 0 || !(load_dependent_friction<typename E::core_type> || ...));
  [[nodiscard]] jacobian_matrix jacobian(const S& t, const state& x) const requires(has_jacobian) {
    jacobian_matrix j;
    jacobian(t, x, j);
    return j;
  }
  void jacobian(const S& t, const state& x, jacobian_matrix& j) const requires(has_jacobian) { derive(t, x, j); }
  /// (J B): `jacobian`, and the derivatives B of x' by inputs. Without `jacobian`, both are computed by dual numbers.
  [[nodiscard]] auto jacobian_with_inputs(const S& t, const state& x) const {
    static_assert(sizeof(detail::check_contacts_of<chain_type>) > 0);
    Eigen::Matrix<S, size::x_dot, size::x_dot + size::u> j;
    if constexpr (has_jacobian) {
      derive(t, x, j);
    } else {
      derive_by_duals(t, x, j);
    }
    return j;
  }
  /// The generalized forces M a at x, N and Nm: those of gravity, elements and inputs, minus Coriolis and centrifugal
  /// forces.
  [[nodiscard]] joint_vector<S, size::v> forces_at(const state& x, const S& t = S(0)) const {
    const S *q = x.data(), *v = q + size::q;
    const detail::configuration<S, wiring, const S*> at(q);
    const auto bases = bases_at(t, v + size::v);
    return detail::generalized_forces<S>(
        this->chain(), detail::given{at, detail::each<S, const S*>{v}, detail::same<zero_t>{}, bases}, one);
  }

  /// The number of elements that may lock a coordinate (models/modes.hpp).
  static constexpr std::size_t lock_count = (std::size_t{locks_coordinate<typename E::core_type>} + ... + 0);
  /// The elements that may lock a coordinate, with their coordinates and modes.
  static constexpr auto locks() { return locks_of(std::index_sequence_for<E...>{}); }
  /// The holding forces that keep the present accelerations, N and Nm.
  [[nodiscard]] joint_vector<S, size::v> needed_forces(const S& t, const state& x) const {
    const S *q = x.data(), *v = q + size::q;
    const rate r = computeStateRate(t, x);
    const detail::configuration<S, wiring, const S*> at(q);
    using numbers = detail::each<S, const S*>;
    const auto bases = bases_at(t, v + size::v);
    return detail::generalized_forces<S>(this->chain(),
                                         detail::given{at, numbers{v}, numbers{r.data() + size::v}, bases}, minus_one);
  }
  /// The largest holding force of an element, N or Nm.
  [[nodiscard]] S capacity(const S& t, const state& x, std::size_t element) const {
    auto s = make_state<S>(this->chain());
    if constexpr ((detail::locks_by_load<typename E::core_type> || ...))
      s = state_at(t, x);
    else
      setJointStates(t, x, s), this->doMotion(s);
    return capacity_of(s, element, std::index_sequence_for<E...>{});
  }

  using base::input;
  /// The value of an input: `model.input(motor) = 2.0`. An input of three numbers is an Eigen vector.
  template <key_type Key>
  decltype(auto) input(const Key&) {
    constexpr int slot = wiring::template find<Key>();
    static_assert(slot >= 0 && nu_of(Key::what) > 0, "kte: this chain has no input of this name");
    constexpr int place = wiring::input_place(Key::what, slot);
    static_assert(slot < 0 || place >= 0,
                  "kte: this is not an input: an element of the chain writes it, or it is the time");
    if constexpr (Key::what == kind::vector) {
      return this->u_.template segment<3>(place < 0 ? 0 : place);
    } else {
      return (this->u_[place < 0 ? 0 : place]);
    }
  }

  /// The state x of a state of the chain.
  [[nodiscard]] state getJointStates(const chain_state<S, wiring>& s) const {
    state x = this->make_x(positions(s), velocities(s));
    for (int i = 0; i < size::own_z; ++i) x[size::q + size::v + i] = s.template get<kind::internal>(i).z;
    this->each_contact([&](int i, int first) { detail::put_mode(s.template get<kind::contact>(i), first, x); });
    return x;
  }
  /// Stores the time, x and the inputs in a state of the chain. Frames are updated by the next doMotion.
  void setJointStates(const S& t, const state& x, chain_state<S, wiring>& s) const {
    setJointStates(x, s);
    for (int i = 0; i < wiring::table.signals; ++i)
      if (const auto& signal = wiring::table.signal[static_cast<std::size_t>(i)]; signal.u < 0)
        s.template get<kind::input>(signal.slot) = t;
  }
  /// Stores x and the inputs in a state of the chain; the time is unchanged.
  void setJointStates(const state& x, chain_state<S, wiring>& s) const {
    set_positions(s, x.data()), set_velocities(s, x.data() + size::q);
    for (int i = 0; i < size::own_z; ++i) s.template get<kind::internal>(i).z = x[size::q + size::v + i];
    this->each_contact([&](int i, int first) { detail::read_mode(x, first, s.template get<kind::contact>(i)); });
    for (int i = 0; i < wiring::table.signals; ++i) {
      const auto& signal = wiring::table.signal[static_cast<std::size_t>(i)];
      if (signal.what == kind::vector)
        s.template get<kind::vector>(signal.slot) = {this->u_[signal.u], this->u_[signal.u + 1],
                                                     this->u_[signal.u + 2]};
      else if (signal.u >= 0)
        s.template get<kind::input>(signal.slot) = this->u_[signal.u];
    }
  }
  /// A state of the chain at x, with all its frames, accelerations and forces.
  [[nodiscard]] auto state_at(const S& t, const state& x) const {
    auto s = make_state<S>(this->chain());
    setJointStates(t, x, s);
    if constexpr (constrained)
      at_run_time().put_dynamics(t, x, s);
    else
      set_accelerations(s, computeStateRate(t, x).data() + size::v);
    this->doMotion(s), this->clearForce(s), this->doForce(s);
    return s;
  }

  template <class X>
  requires(X::SizeAtCompileTime == Eigen::Dynamic) auto state_at(const S& t, const Eigen::MatrixBase<X>& x) const {
    return state_at(t, state(this->checked(x.derived())));
  }

  /// The output y: (q, v), or the function of `with_output`.
  [[nodiscard]] auto computeOutput(const S& t, const state& x) const {
    if constexpr (std::is_void_v<Output>) {
      return x.template head<size::q + size::v>().eval();
    } else {
      return output_(state_at(t, x));
    }
  }
  template <class X>
  requires(X::SizeAtCompileTime == Eigen::Dynamic) auto computeOutput(const S& t, const Eigen::MatrixBase<X>& x) const {
    return computeOutput(t, state(this->checked(x.derived())));
  }
  /// Whether the output is a function of `with_output`, not (q, v).
  static constexpr bool has_output() { return !std::is_void_v<Output>; }
  /// The system in another scalar, such as dual numbers, with which rates and outputs have derivatives.
  template <class T>
  [[nodiscard]] auto in_scalar() const {
    const auto made = [this] {
      using other = manipulator_dynamics_model<chain_type, T, Output>;
      if constexpr (std::is_void_v<Output>) {
        return other(this->chain());
      } else {
        return other(this->chain(), output_);
      }
    };
    auto m = made();
    m.setInput(this->u_);
    return m;
  }
  /// The system with another output: `model.with_output([](const auto& s) { return s[tip].position.x; })`.
  template <class F>
  [[nodiscard]] auto with_output(const F& f) const {
    manipulator_dynamics_model<chain_type, S, F> m(this->chain(), f);
    m.setInput(this->u_);
    return m;
  }

 private:
  template <std::size_t... I>
  static constexpr auto locks_of(std::index_sequence<I...>) {
    std::array<detail::lock_place, lock_count> all{};
    std::size_t n = 0;
    const auto add = [&]<std::size_t J>() {
      using core = typename chain_type::template core_type<J>;
      if constexpr (locks_coordinate<core>) {
        constexpr int row = wiring::freedom_of(kind::gen, wiring::slot(J, 0)).v;
        all[n++] = {J, row, size::q + row, size::q + size::v + wiring::slot(J, detail::kept_port<core>)};
      }
      return 0;
    };
    const int done[]{add.template operator()<I>()...};
    (void)done;
    return all;
  }
  state started(state x) const {
    if constexpr ((starts_in_place<typename E::core_type> || ...)) start_in_place(x, std::index_sequence_for<E...>{});
    return x;
  }
  template <std::size_t... I>
  void start_in_place(state& x, std::index_sequence<I...>) const {
    auto s = make_state<S>(this->chain());
    setJointStates(x, s), this->doMotion(s);
    const auto start = [&]<std::size_t J>() {
      using element_core = typename chain_type::template core_type<J>;
      if constexpr (starts_in_place<element_core>)
        detail::stored_element<element_core, decltype(s), detail::by_index>{
            this->template core<J>(), s, {wiring::table.slot.data() + wiring::first[J]}}
            .switch_over(std::make_index_sequence<input_count<element_core>>{});
      return 0;
    };
    const int done[]{start.template operator()<I>()...};
    (void)done;
    for (int i = 0; i < size::own_z; ++i) x[size::q + size::v + i] = s.template get<kind::internal>(i).z;
  }
  template <class State, std::size_t... I>
  S capacity_of(State& s, std::size_t element, std::index_sequence<I...>) const {
    S most(0);
    const auto ask = [&]<std::size_t J>() {
      using element_core = typename chain_type::template core_type<J>;
      const detail::stored_element<element_core, State, detail::by_index> on{
          this->template core<J>(), s, {wiring::table.slot.data() + wiring::first[J]}};
      if (J == element) most = as<S>(on.capacity(std::make_index_sequence<input_count<element_core>>{}));
      return 0;
    };
    const int done[]{ask.template operator()<I>()...};
    (void)done;
    return most;
  }
  template <class J>
  void derive(const S& t, const state& x, J& j) const {
    const S *q = x.data(), *v = q + size::q, *z = v + size::v;
    const detail::configuration<S, wiring, const S*> at(q);
    const auto bases = bases_at(t, z);
    const joint_vector<S, size::v> none = joint_vector<S, size::v>::Zero();
    const auto of_accelerations = detail::forward_derivatives_at<S>(this->chain(), at, bases, q, v, none);
    detail::put_rate_derivatives(this->freedoms(), v, of_accelerations, j);
    if constexpr (J::ColsAtCompileTime > 2 * size::v)
      detail::derive_signals(this->chain(), t, x, this->u_, of_accelerations, j);
  }
  /// All derivatives of models/detail/rate_derivatives.hpp by dual numbers.
  template <class J>
  void derive_by_duals(const S& t, const state& x, J& j) const {
    using number = dual<S, 4>;
    auto m = this->template in_scalar<number>();
    const rate at_x = computeStateRate(t, x);
    for (int first = 0; first < j.cols(); first += number::variables) {
      Eigen::Matrix<number, size::u, 1> u = this->u_.template cast<number>();
      for (int lane = 0; lane < number::variables; ++lane)
        if (const int i = first + lane - size::x_dot; i >= 0 && i < size::u)
          u[i].derivative[static_cast<std::size_t>(lane)] = S(1);
      m.setInput(u);
      const auto r = m.computeStateRate(t, detail::moved_along<number>(this->freedoms(), size::x_dot, x, first));
      for (int k = first; k < (std::min)(first + number::variables, static_cast<int>(j.cols())); ++k)
        for (int i = 0; i < size::x_dot; ++i) j(i, k) = r[i].derivative[static_cast<std::size_t>(k - first)];
    }
    for (const detail::freedom& f : this->freedoms()) detail::add_variation_of_pull_back<S>(f, at_x, j);
  }
  void check_chain() const {
    if constexpr (constrained) (void)at_run_time();
  }
  /// Bases at rest, with the signals of the chain.
  auto bases_at(const S& t, const S* z) const {
    return detail::with_signals<wiring>(detail::base_under_gravity(this->chain()), t, this->u_.data(), z);
  }
  template <class, class, class>
  friend class manipulator_dynamics_model;
  template <class>
  friend struct detail::static_model_at_run_time;
  template <class Model>
  friend class detail::contact_stepper;
  template <class F>
  manipulator_dynamics_model(const chain_type& c, const F& f) : base(c), output_(f) {}

  /// The model of the chain at run time, with the inputs of this one.
  auto at_run_time() const { return detail::static_model_at_run_time<chain_type>(*this); }

  [[no_unique_address]] mutable std::conditional_t<constrained, detail::own_memory, detail::no_value> constraints_;
  struct no_output {};
  [[no_unique_address]] std::conditional_t<std::is_void_v<Output>, no_output, Output> output_;
};
template <class Gravity, class... E>
manipulator_dynamics_model(const static_chain<Gravity, E...>&)
    -> manipulator_dynamics_model<static_chain<Gravity, E...>>;

}  // namespace kte
