#ifndef KTE_DERIVATIVES_HPP
#define KTE_DERIVATIVES_HPP

#include <kte/dynamics/detail/column_groups.hpp>
#include <kte/dynamics/detail/coordinate_derivatives.hpp>
#include <kte/dynamics/detail/dual_derivatives.hpp>
#include <kte/dynamics/detail/local_derivatives.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix_inverse.hpp>

namespace kte {

namespace detail {
/// Whether the derivatives of a chain are known element by element.
template <class Chain>
inline constexpr bool is_analytical =
    is_tree_of_joints<Chain>&& Chain::common&&[]<std::size_t... I>(std::index_sequence<I...>) {
  const bool all_known[]{has_derivatives<typename Chain::template core_type<I>>..., true};
  for (const bool k : all_known)
    if (!k) return false;
  return true;
}
(std::make_index_sequence<Chain::size>{});

/// At q, v and a, with bases and inputs as given.
template <class S, class Chain, class At, class Base, class Q, class V, class A>
KTE_INLINE auto derivatives_at(const Chain& c, const At& at, const Base& base, const Q& q, const V& v, const A& a) {
  static_assert(sizeof(check_loads_of<Chain>) > 0);
  inverse_dynamics_result<S, Chain::dofs> r;
  if constexpr (is_analytical<Chain>) {
    const given g{at, each<S, V>{v}, each<S, A>{a}, base};
    if constexpr (is_unrolled<Chain, S>) {
      r.by_q.setZero(), r.by_v.setZero(), r.by_a.setZero();
      using given_type = std::remove_const_t<decltype(g)>;
      const local_derivatives<S, Chain, given_type> pass(c, g, r.by_q, r.by_v, r.by_a);
      coordinate_derivatives<S, Chain, given_type>{c, g, r.by_q, r.by_v, r.by_a}.subtract();
      r.tau = forces_of<S>(pass, minus_one);
    } else {
      derivatives_by_records<S>(c, g, r);
    }
    check_forces<typename Chain::wiring>(r.tau, g);
  } else {
    dual_derivatives<S>(c, base, q, v, a, r);
    if constexpr (!reads_reactions<Chain>) r.by_a = local_mass_matrix<S>(c, at, base);
  }
  return r;
}

/// From accelerations a under tau and the derivatives of inverse dynamics there:
///
///   da/dq = -M^-1 dtau/dq,   da/dv = -M^-1 dtau/dv,   da/dtau = M^-1          (1)
///
/// with dtau/da for M where friction depends on what joints carry, and so on accelerations.
template <class S, class Chain, class At, class Base, class Q, class V>
KTE_INLINE auto forward_derivatives_at(const Chain& c, const At& at, const Base& base, const Q& q, const V& v,
                                       const joint_vector<S, Chain::dofs>& tau) {
  forward_dynamics_result<S, Chain::dofs> r;
  const each<S, V> rates{v};
  constexpr bool rubs = reads_reactions<Chain>, inverted = !rubs && (is_tree_of_joints<Chain> || !Chain::common);
  if constexpr (inverted) {
    at.check(), base.check();
    const given<At, each<S, V>, same<zero_t>, Base, true> g{at, rates, {}, base};
    if constexpr (is_unrolled<Chain, S>) {
      local_inverse_mass<S, Chain, std::remove_const_t<decltype(g)>>(c, g).accelerate_and_invert(tau, r.a, r.by_tau);
    } else {
      accelerations_and_inverse_by_records<S>(c, g, tau, r.a, r.by_tau);
    }
  } else {
    r.a = accelerations_under<S>(c, at, rates, base, tau);
  }
  auto of_forces = derivatives_at<S>(c, at, base, q, v, r.a);
  if constexpr (rubs)
    invert_by_records<S>(c, given{at, rates, same<zero_t>{}, base}, of_forces.by_a, r.by_tau);
  else if constexpr (!inverted)
    invert_by_factors(of_forces.by_a, r.by_tau,
                      [&at](int row) { blame_mass<typename Chain::wiring>(row, true, at.q); });
  if constexpr (is_unrolled<Chain, S>)
    solve_by_groups<Chain, is_analytical<Chain>>(r.by_tau, of_forces.by_q, of_forces.by_v, r.by_q, r.by_v);
  else
    solve_by_inverse(r.by_tau, of_forces.by_q, r.by_q), solve_by_inverse(r.by_tau, of_forces.by_v, r.by_v);
  return r;
}
}  // namespace detail

/// Inverse dynamics and its derivatives by q, v and a, dofs x dofs each; by_a is the mass matrix, less the derivatives
/// of friction that depends on what joints carry. In a tree of joints and bodies, with springs, dampers and masses on
/// coordinates, by recursion over the elements (kernels/variation.hpp); where other forces act between frames, or
/// coordinates follow others, by dual numbers.
///
///   inverse_dynamics_derivatives(c, q, v, a)       of a static chain, a value
///   inverse_dynamics_derivatives(c, s, q, v, a)    of a runtime chain, in the state s, for which the first call makes
///                                                  room
///   inverse_dynamics_derivatives(c, s)             of both, at the positions, rates and accelerations of a state
///
/// Arguments and errors as for `inverse_dynamics`. Throws `bad_argument` also for a chain of which an element moves or
/// acts by more than records say.
template <class Gravity, class... E, indexable Q, indexable V, indexable A>
auto inverse_dynamics_derivatives(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const A& a) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  check_size<chain_type::dofs>(v, "v"), check_size<chain_type::dofs>(a, "a");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  at.check();
  return detail::derivatives_at<S>(c, at, detail::base_under_gravity(c), q, v, a);
}
template <class Gravity, class... E, class S>
auto inverse_dynamics_derivatives(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s), a = accelerations(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  at.check();
  return detail::derivatives_at<S>(c, at, detail::base_of_state<state>{s}, q, v, a);
}

/// Forward dynamics and its derivatives, from those of inverse dynamics and the inverse of the mass matrix, which has
/// all digits of `mass_matrix_inverse`. Arguments and errors as for `forward_dynamics`, results as above.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
auto forward_dynamics_derivatives(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  constexpr int n = chain_type::dofs;
  detail::check_configuration<chain_type>(q), check_size<n>(v, "v"), check_size<n>(tau, "tau");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  joint_vector<S, n> f;
  for (int i = 0; i < n; ++i) f[i] = S(tau[static_cast<std::size_t>(i)]);
  return detail::forward_derivatives_at<S>(c, at, detail::base_under_gravity(c), q, v, f);
}
template <class Gravity, class... E, class S>
auto forward_dynamics_derivatives(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using state = chain_state<S, detail::wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  using vector = joint_vector<S, state::dofs>;
  return detail::forward_derivatives_at<S>(c, at, detail::base_of_state<state>{s}, q, v, vector(vector::Zero()));
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/dynamics/runtime_parts.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_DERIVATIVES_OF_RUNTIME_CHAINS)
#define KTE_DERIVATIVES_OF_RUNTIME_CHAINS

#include <kte/dynamics/detail/runtime_duals.hpp>
#include <kte/dynamics/forward_dynamics.hpp>
#include <kte/tree/solve_limbs.hpp>

namespace kte {

namespace detail {
/// Whether the derivatives of the forces of a chain are known element by element.
template <class S>
bool is_known_by_elements(const kte_map_chain& c, const basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  return t.on_frames.empty() && t.followers.empty() && t.late.empty() && t.readers.empty() &&
         c.wiring().has_derivatives;
}
template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& forces_derived(const kte_map_chain& c, basic_runtime_state<S>& s,
                                                                 bool moved = false) {
  coordinate_forces(c, s, moved);
  take_needed_forces(s);
  auto& r = s.work.of_forces;
  if constexpr (std::is_same_v<S, double>) {
    if (is_known_by_elements(c, s)) [[likely]]
      derive_forces(runtime_elements{c}, s);
    else
      derive_forces_by_duals(c, s);
  } else {  // joints, links and bodies alone
    derive_forces(runtime_elements{c}, s);
  }
  r.tau = s.work.forces;
  check_result(r.tau, static_cast<std::size_t>(s.dofs()), [&s] { blame("a force", s); });
  return r;
}
}  // namespace detail

template <class S>
const inverse_dynamics_result<S, Eigen::Dynamic>& inverse_dynamics_derivatives(const kte_map_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  detail::check_positions(s);
  return detail::forces_derived(c, s);
}
template <class S, indexable Q, indexable V, indexable A>
const auto& inverse_dynamics_derivatives(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const A& a) {
  detail::check_regular(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q, v, a).call([&]() -> const auto& {
    return detail::forces_derived(c, s);
  });
}

namespace detail {
/// After forward dynamics: (1).
template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& accelerations_derived(const kte_map_chain& c,
                                                                        basic_runtime_state<S>& s) {
  auto& r = s.work.of_accelerations;
  const Eigen::Index n = s.dofs();
  r.a = s.work.forces;
  r.by_q.resize(n, n), r.by_v.resize(n, n);
  if constexpr (std::is_same_v<S, double>)
    if (!s.tree().readers.empty()) [[unlikely]] {
      const auto& forces = forces_derived(c, s);
      invert_unheld_rubbing(runtime_elements{c}, s, forces.by_a, r.by_tau);
      solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
      return r;
    }
  if (s.tree().plan.tree && s.tree().holders.empty()) [[likely]]
    invert_articulated(s, r.by_tau);
  else
    invert_unheld(runtime_elements{c}, s, r.by_tau);
  const auto& forces = forces_derived(c, s, true);
  const auto& t = s.tree();
  if (t.holders.empty() && t.forest.in_order && static_cast<Eigen::Index>(t.forest.axes()) == n)
    tree::solve_limbs(t.forest, !t.only_bodies, s.work.rows, r.by_tau.data(), forces.by_q.data(), forces.by_v.data(),
                      r.by_q.data(), r.by_v.data());
  else
    solve_by_inverse(r.by_tau, forces.by_q, r.by_q), solve_by_inverse(r.by_tau, forces.by_v, r.by_v);
  return r;
}
}  // namespace detail

template <class S>
const forward_dynamics_result<S, Eigen::Dynamic>& forward_dynamics_derivatives(const kte_map_chain& c,
                                                                               basic_runtime_state<S>& s) {
  detail::check_regular(c, s);
  return detail::keep_accelerations(s).call([&]() -> const auto& {
    forward_dynamics(c, s);
    return detail::accelerations_derived(c, s);
  });
}
template <class S, indexable Q, indexable V, indexable T>
const auto& forward_dynamics_derivatives(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                         const T& tau) {
  detail::check_regular(c, s);
  return detail::take(c, s, q, v, detail::found_later{}, tau).call([&]() -> const auto& {
    detail::accelerations_under(c, s, [&](int i) { return static_cast<S>(tau[static_cast<std::size_t>(i)]); });
    return detail::accelerations_derived(c, s);
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& inverse_dynamics_derivatives(
    const kte_map_chain&, runtime_state&);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& forward_dynamics_derivatives(
    const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template const inverse_dynamics_result<double, Eigen::Dynamic>& forces_derived(const kte_map_chain&,
                                                                                          runtime_state&, bool);
KTE_EXTERN template const forward_dynamics_result<double, Eigen::Dynamic>& accelerations_derived(const kte_map_chain&,
                                                                                                 runtime_state&);
}  // namespace detail
#endif

}  // namespace kte

#endif
