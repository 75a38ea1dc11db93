#pragma once

#include <kte/dynamics/closed_loops/actuated_forces.hpp>
#include <kte/dynamics/runtime/at_run_time.hpp>
#include <kte/dynamics/unrolled/arguments.hpp>

/// Closed loops of static chains, by the algorithms of runtime chains. Arguments, results and errors as there, without
/// a state; coordinates also by keys.
namespace kte {

/// The closures of a static chain in a result, by key.
template <class Chain>
struct static_loop_results {
  /// By slot.
  std::array<loop_state<>, static_cast<std::size_t>(Chain::wiring::count(kind::loop))> loops;

  /// The forces and residuals of a closure.
  template <key_type Key>
  const loop_state<>& loop(const Key&) const {
    constexpr int slot = Key::what == kind::loop ? Chain::wiring::template find<Key>() : -1;
    static_assert(slot >= 0, "kte: this chain has no closure of this name (loop_key)");
    return loops[slot < 0 ? 0 : std::size_t{slot}];
  }
  /// The force of a closure, N, in axes of its first frame.
  template <key_type Key>
  const vec3<>& force(const Key& key) const {
    return loop(key).force;
  }
};
/// The result of `constrained_dynamics` of a static chain.
template <class Chain>
struct static_constrained_dynamics_result : static_loop_results<Chain> {
  joint_vector<double, Chain::dofs> a;  ///< accelerations
  int rank = 0, mobility = 0;           ///< number of independent rows of closures; dofs - rank
  double gap = 0;                       ///< the largest residual, m or rad: above rounding, q is off the loops
  std::vector<std::string> dependent;   ///< redundant rows, which have no force
};

namespace detail {
template <class Gravity, class... E>
struct static_loops<static_chain<Gravity, E...>> {
  using chain_type = static_chain<Gravity, E...>;
  using vector = joint_vector<double, chain_type::dofs>;

  template <class S, class Given>
  static vector accelerations(const chain_type& c, const Given& g, const vector& tau) {
    static_assert(std::is_same_v<S, double>, "kte: closed loops are computed in double");
    check_accelerations<typename chain_type::wiring>(tau, g, tau);  // names a force that is not finite
    return at_run_time_with(c, g, [&tau](const auto& r, auto& s) -> vector {
      keep_forces(s, [&tau](int i) { return tau[i]; });
      return accelerations_at_state(r, s);
    });
  }
};
/// Copies the closures of a runtime state.
template <class Chain>
void copy_loops(const runtime_state& from, static_loop_results<Chain>& to) {
  for (std::size_t i = 0; i < to.loops.size(); ++i) to.loops[i] = from.get<kind::loop>(static_cast<int>(i));
}
}  // namespace detail

/// As for runtime chains; r.loop(pin).force, or r.force(pin).
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto constrained_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  static_assert(sizeof(detail::check_contacts_of<chain_type>) > 0);
  return detail::at_run_time(c, q, v, tau, [](auto&... at) {
    const constrained_dynamics_result& found = constrained_dynamics(at...);
    static_constrained_dynamics_result<chain_type> r;
    r.a = found.a, r.rank = found.rank, r.mobility = found.mobility, r.gap = found.gap, r.dependent = found.dependent;
    std::copy(found.loops.begin(), found.loops.end(), r.loops.begin());
    return r;
  });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] loops_report loops(const static_chain<Gravity, E...>& c, const Q& q) {
  return detail::at_run_time(c, q, [](auto&... at) { return kte::loops(at...); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd loop_jacobian(const static_chain<Gravity, E...>& c, const Q& q) {
  return detail::at_run_time(c, q, [](auto&... at) { return loop_jacobian(at...); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto consistent_velocities(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using vector = joint_vector<double, static_chain<Gravity, E...>::dofs>;
  return detail::at_run_time(c, q, v, [](auto&... at) -> vector { return consistent_velocities(at...); });
}
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto impulse(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  return consistent_velocities(c, q, v);
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto assemble(const static_chain<Gravity, E...>& c, const Q& guess, const held_coordinates& held = {}) {
  using vector = joint_vector<double, static_chain<Gravity, E...>::nq>;
  return detail::at_run_time(c, guess, [&](auto&... at) -> vector { return assemble(at..., held); });
}
template <class Gravity, class... E, indexable Q>
[[nodiscard]] Eigen::MatrixXd loop_motion(const static_chain<Gravity, E...>& c, const Q& q,
                                          const actuated_coordinates& by) {
  return detail::at_run_time(c, q, [&](auto&... at) { return loop_motion(at..., by); });
}
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
[[nodiscard]] Eigen::VectorXd inverse_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a,
                                               const actuated_coordinates& by) {
  static_assert(sizeof(detail::check_contacts_of<static_chain<Gravity, E...>>) > 0);
  return detail::at_run_time(
      c, q, v, a, [&](auto&... at) { return inverse_dynamics(at..., by); }, "a");
}

}  // namespace kte
