#pragma once

#include <kte/dynamics/detail/internal_rates.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/models/detail/displacement.hpp>
#include <kte/models/state_rate_function.hpp>

namespace kte {

namespace detail {
/// Where the numbers of a chain stand in a state x = (q, v, z) and in its rate (v, a, z'), and inputs and outputs.
template <class Chain>
struct sizes_of_model {
  using wiring = typename Chain::wiring;
  static constexpr int q = wiring::nq, v = wiring::dofs;
  static constexpr int z = wiring::count(kind::internal), u = wiring::count(kind::input);
  static constexpr bool only_numbers = [] {
    for (std::size_t i = 0; i < wiring::freedoms; ++i)
      if (wiring::table.free[i].what != kind::gen) return false;
    return true;
  }();
};
}  // namespace detail

/// A chain as a dynamic system:
///
///   x = (q, v, z)              positions, rates, internal states of elements
///   x' = (v, a, z')            a = M(q)^-1 (f(q, v, z, u)), by `forward_dynamics`         (1)
///   y = (q, v), or output(s)   of a state s of the chain at x, with accelerations and forces
///
/// u: the chain's inputs, in order of their first appearance. The model is the chain, with all that there is for
/// chains; and a right-hand side for integrators:
///
///   kte::manipulator_dynamics_model arm(chain);
///   kte::dormand_prince45 solver(std::ref(arm), 0.0, arm.make_x(q, v));
///
/// Where coordinates are rotations or poses, q holds quaternions and integrators move on the group
/// (integrators/motion_space.hpp); x' has as many numbers as there are velocities. No heap, no virtual calls. A value;
/// the chain must not have moving bases.
template <class Chain, class S = double, class Output = void>
class manipulator_dynamics_model : public Chain {
  using wiring = typename Chain::wiring;
  using size = detail::sizes_of_model<Chain>;

 public:
  using state = Eigen::Matrix<S, size::q + size::v + size::z, 1>;
  using rate = Eigen::Matrix<S, 2 * size::v + size::z, 1>;
  using input_vector = Eigen::Matrix<S, size::u, 1>;
  using chain_state_type = chain_state<S, wiring>;

  explicit manipulator_dynamics_model(const Chain& c) : Chain(c) {}

  // ---- states

  /// x of q and v, and of z = 0 or given. Throws `bad_argument` for wrong sizes.
  template <indexable Q, indexable V>
  state make_x(const Q& q, const V& v) const {
    return make_x(q, v, Eigen::Matrix<S, size::z, 1>(Eigen::Matrix<S, size::z, 1>::Zero()));
  }
  template <indexable Q, indexable V, indexable Z>
  state make_x(const Q& q, const V& v, const Z& z) const {
    detail::check_configuration<Chain>(q), check_size<size::v>(v, "v"), check_size<size::z>(z, "z", "internal states");
    state x;
    for (std::size_t i = 0; i < std::size_t{size::q}; ++i) x[Eigen::Index(i)] = S(q[i]);
    for (std::size_t i = 0; i < std::size_t{size::v}; ++i) x[Eigen::Index(size::q + i)] = S(v[i]);
    for (std::size_t i = 0; i < std::size_t{size::z}; ++i) x[Eigen::Index(size::q + size::v + i)] = S(z[i]);
    return x;
  }
  static auto positions_of(const state& x) { return x.template head<size::q>(); }
  static auto velocities_of(const state& x) { return x.template segment<size::v>(size::q); }
  static auto internals_of(const state& x) { return x.template tail<size::z>(); }

  /// x of a state of the chain.
  state getJointStates(const chain_state_type& s) const {
    state x = make_x(positions(s), velocities(s));
    for (int i = 0; i < size::z; ++i) x[size::q + size::v + i] = s.template get<kind::internal>(i).z;
    return x;
  }
  /// Puts x and the inputs into a state of the chain. Frames follow with the next doMotion.
  void setJointStates(const state& x, chain_state_type& s) const {
    set_positions(s, x.data()), set_velocities(s, x.data() + size::q);
    for (int i = 0; i < size::z; ++i) s.template get<kind::internal>(i).z = x[size::q + size::v + i];
    for (int i = 0; i < size::u; ++i) s.template get<kind::input>(i) = u_[i];
  }
  /// A state of the chain at x, with frames, accelerations and forces: f of the coordinates is then (1)'s M a.
  chain_state_type state_at(const S& t, const state& x) const {
    auto s = make_state<S>(static_cast<const Chain&>(*this));
    setJointStates(x, s);
    const rate r = computeStateRate(t, x);
    set_accelerations(s, r.data() + size::v);
    this->doMotion(s), this->clearForce(s), this->doForce(s);
    return s;
  }

  // ---- the system

  /// (1). Throws `bad_argument` for numbers that are not finite, `singular_mass_matrix`.
  rate computeStateRate(const S&, const state& x) const {
    const S *q = x.data(), *v = q + size::q, *z = v + size::v;
    const detail::configuration<S, wiring, const S*> at(q);
    const auto base = detail::with_signals(detail::base_under_gravity<Chain>(*this), u_.data(), z);
    rate r;
    r.template head<size::v>() = velocities_of(x);
    const joint_vector<S, size::v> none = joint_vector<S, size::v>::Zero();
    r.template segment<size::v>(size::v) =
        detail::accelerations_under<S>(static_cast<const Chain&>(*this), at, detail::each<S, const S*>{v}, base, none);
    if constexpr (size::z > 0) detail::internal_rates(static_cast<const Chain&>(*this), at, v, base, &r[2 * size::v]);
    return r;
  }
  rate operator()(const S& t, const state& x) const { return computeStateRate(t, x); }

  /// Throws `bad_argument` for another count of numbers than the chain has inputs.
  template <indexable U>
  void setInput(const U& u) {
    check_size<size::u>(u, "u", "inputs");
    for (int i = 0; i < size::u; ++i) u_[i] = S(u[static_cast<std::size_t>(i)]);
  }
  const input_vector& input() const { return u_; }
  template <key_type Key>
  S& input(const Key&) {
    constexpr int i = wiring::template find<Key>();
    static_assert(i >= 0 && Key::what == kind::input, "kte: this chain has no input of this name");
    return u_[i < 0 ? 0 : i];
  }

  auto computeOutput(const S& t, const state& x) const {
    if constexpr (std::is_void_v<Output>) {
      return x.template head<size::q + size::v>().eval();
    } else {
      return output_(state_at(t, x));
    }
  }
  /// The same system with another output: `model.with_output([](const auto& s) { return s[tip].position.x; })`.
  template <class F>
  auto with_output(const F& f) const {
    manipulator_dynamics_model<Chain, S, F> m(*this, f);
    m.setInput(u_);
    return m;
  }

  // ---- motion on the group, where there are rotations
  static constexpr Eigen::Index rates() { return rate::RowsAtCompileTime; }
  void displace(const state& x, const rate& d, state& out) const requires(!size::only_numbers) {
    const S* from = x.data();
    for (std::size_t i = 0; i < wiring::freedoms; ++i)
      detail::displace_one<S>(wiring::table.free[i], from, d.data(), out);
    out.template tail<size::v + size::z>() =
        x.template tail<size::v + size::z>() + d.template tail<size::v + size::z>();
  }
  void pull_back(const rate& d, rate& r) const requires(!size::only_numbers) {
    for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::pull_back_one<S>(wiring::table.free[i], d.data(), r);
  }
  void magnitudes(const state& x, rate& m) const requires(!size::only_numbers) {
    for (std::size_t i = 0; i < wiring::freedoms; ++i) detail::magnitudes_of<S>(wiring::table.free[i], x.data(), m);
    m.template tail<size::v + size::z>() = x.template tail<size::v + size::z>();
  }

 private:
  template <class, class, class>
  friend class manipulator_dynamics_model;
  template <class F>
  manipulator_dynamics_model(const Chain& c, const F& f) : Chain(c), output_(f) {}

  struct no_output {};
  input_vector u_ = input_vector::Zero();
  [[no_unique_address]] std::conditional_t<std::is_void_v<Output>, no_output, Output> output_;
};
template <class Gravity, class... E>
manipulator_dynamics_model(const static_chain<Gravity, E...>&)
    -> manipulator_dynamics_model<static_chain<Gravity, E...>>;

}  // namespace kte
