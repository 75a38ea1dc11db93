#ifndef KTE_FORWARD_DYNAMICS_HPP
#define KTE_FORWARD_DYNAMICS_HPP

#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>
#include <kte/dynamics/unrolled/articulated.hpp>
#include <kte/dynamics/unrolled/flattened.hpp>
#include <kte/kernels/solve.hpp>

namespace kte {

namespace detail {
/// By articulated bodies where the chain is a tree of joints or not unrolled, otherwise by the factorised mass matrix.
template <class S, class Chain, class At, class V, class Base>
KTE_INLINE auto accelerations_under(const Chain& c, const At& at, const V& v, const Base& base,
                                    const joint_vector<S, Chain::dofs>& tau) {
  static_assert(sizeof(check_contacts_of<Chain>) > 0);
  at.check(), base.check();
  joint_vector<S, Chain::dofs> a;
  if constexpr (has_closures<Chain>) {
    a = static_loops<Chain>::template accelerations<S>(c, given{at, v, same<zero_t>{}, base}, tau);
  } else if constexpr (is_tree_of_joints<Chain> || !Chain::common || !is_unrolled<Chain, S>) {
    static_assert(sizeof(check_loads_of<Chain>) > 0);
    using given_type = given<At, V, same<zero_t>, Base, true>;
    const given_type g{at, v, {}, base};
    if constexpr (is_unrolled<Chain, S>) {
      using bodies = articulated_chain<S, Chain, given_type>;
      static_assert(sizeof(typename bodies::need) > 0);
      bodies(c, g).accelerate(tau, a);
    } else {
      a = accelerations_by_tree<S>(c, g, tau);
    }
  } else {
    a = tau + generalized_forces<S>(c, given{at, v, same<zero_t>{}, base}, one);
    auto m = mass_matrix_at<S>(c, at, base);
    solve_in_place(m, a, [&at](int row) { diagnose_mass<typename Chain::wiring>(row, true, at.q); });
    check_accelerations<typename Chain::wiring>(a, given{at, v, same<zero_t>{}, base}, tau);
  }
  return a;
}
}  // namespace detail

/// Forward dynamics:
///
///   a = M(q)^-1 (tau - bias),   bias = the inverse dynamics for a = 0          (1)
///
/// in a chain of joints and links by the articulated-body algorithm (ABA; Featherstone 2008, section 7.3), which does
/// not form M and keeps its accuracy where M is ill-conditioned (docs/decisions/05-forward-dynamics.md). Coordinates
/// that follow others, or move two joints, are clusters in it (recursions/cluster.hpp); unrolled static chains with
/// them factorize M. tau: applied forces on the degrees of freedom in addition to those of the elements, Nm and N.
/// Returns accelerations, dofs numbers, rad/s^2 and m/s^2.
///
///   forward_dynamics(c, q, v, tau)       of a static chain, a value
///   forward_dynamics(c, s, q, v, tau)    of a runtime chain, in the state s, whose coordinates get the accelerations
///   forward_dynamics(c, s)               of both, at the positions and rates of a state under its inputs, without tau
///
/// Arguments and errors as for `inverse_dynamics`, chains as for `mass_matrix`. Throws `singular_mass_matrix`.
///
/// For a runtime chain with closures of loops, accelerations are those of `constrained_dynamics` (kte/loops.hpp), and
/// the closures in the state get their forces.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
[[nodiscard]] auto forward_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  constexpr int n = chain_type::dofs;
  detail::check_configuration<chain_type>(q), check_size<n>(v, "v"), check_size<n>(tau, "tau");
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  joint_vector<S, n> f;
  for (int i = 0; i < n; ++i) f[i] = S(tau[static_cast<std::size_t>(i)]);
  return detail::in_one_function<S, detail::is_unrolled<chain_type, S>>([&]() KTE_INLINE_LAMBDA {
    return detail::accelerations_under<S>(c, at, detail::each<S, V>{v}, detail::base_under_gravity(c), f);
  });
}

template <class Gravity, class... E, class S>
[[nodiscard]] auto forward_dynamics(const static_chain<Gravity, E...>& c,
                                    const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const auto q = positions(s);
  const auto v = velocities(s);
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  using vector = joint_vector<S, state::dofs>;
  return accelerations_under<S>(c, at, each<S, vector>{v}, base_of_state<state>{s}, vector(vector::Zero()));
}

}  // namespace kte

#endif

// ---- runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_FORWARD_DYNAMICS_OF_RUNTIME_CHAINS)
#define KTE_FORWARD_DYNAMICS_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/accelerations.hpp>
#include <kte/dynamics/runtime/refused_calls.hpp>

namespace kte {

template <class S>
const runtime_vector<S>& forward_dynamics(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s);
  detail::check_positions(s);
  detail::keep_forces(s, [](int) { return S(0); });
  return detail::accelerations_at_state(c, s);
}
template <class S, indexable Q, indexable V, indexable T>
const runtime_vector<S>& forward_dynamics(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v,
                                          const T& tau) {
  detail::check_regular_tree(c, s);
  return detail::take(c, s, q, v, detail::not_given{}, tau).call([&]() -> const auto& {
    detail::keep_forces(s, [&](int i) { return static_cast<S>(tau[static_cast<std::size_t>(i)]); });
    return detail::accelerations_at_state(c, s);
  });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_vector<double>& forward_dynamics(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
