#pragma once

#include <kte/dynamics/detail/solve.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/mass_matrix.hpp>

namespace kte {

/// Forward dynamics by the factorised mass matrix:
///
///   a = M(q)^-1 (tau - bias),   bias = the inverse dynamics for a = 0          (1)
///
/// tau: forces applied to the degrees of freedom besides those of the chain's own elements; else as `inverse_dynamics`.
/// Returns accelerations, rad/s^2 and m/s^2. Throws `singular_mass_matrix`.
template <class Gravity, class... E, indexable Q, indexable V, indexable T>
auto forward_dynamics(const static_chain<Gravity, E...>& c, const Q& q, const V& v, const T& tau) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  constexpr int n = chain_type::dofs;
  check_size<n>(q, "q"), check_size<n>(v, "v"), check_size<n>(tau, "tau");
  const detail::positions<S, typename chain_type::wiring, detail::each<S, Q>> at({q});
  joint_vector<S, n> a = detail::coordinate_forces<S>(
      c, detail::given{at, detail::each<S, V>{v}, detail::same<zero_t>{}, detail::base_under_gravity(c)}, one);
  for (int i = 0; i < n; ++i) a[i] += S(tau[static_cast<std::size_t>(i)]);
  auto m = detail::local_mass_matrix<S>(c, at);
  detail::solve_in_place(m, a);
  return a;
}

/// The same at the positions and rates of a state, with its moving bases and its inputs, and no other forces.
template <class Gravity, class... E, class S>
auto forward_dynamics(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  using state = chain_state<S, wiring<E...>>;
  const positions<S, wiring<E...>, of_state<state, &gen_coord<S>::q>> at({s});
  joint_vector<S, static_chain<Gravity, E...>::dofs> a = coordinate_forces<S>(
      c, given{at, of_state<state, &gen_coord<S>::q_dot>{s}, same<zero_t>{}, base_of_state<state>{s}}, one);
  auto m = local_mass_matrix<S>(c, at);
  solve_in_place(m, a);
  return a;
}

}  // namespace kte
