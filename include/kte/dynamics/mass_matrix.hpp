#pragma once

#include <kte/dynamics/detail/local_mass.hpp>
#include <kte/dynamics/state_vectors.hpp>

namespace kte {

/// The mass matrix by the composite-rigid-body algorithm (CRBA; Walker and Orin 1982; Featherstone 2008, section 6.2):
///
///   M_ij = s_i . (I^c_j s_j)   for i upstream of j,  0 where neither is upstream of the other           (1)
///
/// with s the axis of a joint and I^c the inertia of all that it carries. q as for `inverse_dynamics`. Symmetric, both
/// triangles filled; kg m^2, kg m, kg.
template <class Gravity, class... E, indexable Q>
auto mass_matrix(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::local_mass_matrix<S>(c, at, detail::base_under_gravity(c));
}

/// The same at the positions of a state.
template <class Gravity, class... E, class S>
auto mass_matrix(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  using namespace detail;
  const auto q = positions(s);
  const configuration<S, wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return local_mass_matrix<S>(c, at, base_of_state<chain_state<S, wiring<E...>>>{s});
}

}  // namespace kte
