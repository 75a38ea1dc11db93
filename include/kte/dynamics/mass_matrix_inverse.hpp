#pragma once

#include <kte/dynamics/detail/local_inverse_mass.hpp>
#include <kte/dynamics/detail/static_loops.hpp>
#include <kte/dynamics/mass_matrix.hpp>

namespace kte {

namespace detail {
template <class S, class Chain, class At, class Base>
KTE_INLINE auto inverse_mass(const Chain& c, const At& at, const Base& base) {
  static_assert(sizeof(check_loads_of<Chain>) > 0);
  at.check(), base.check();
  joint_matrix<S, Chain::dofs> m;
  if constexpr (is_tree_of_joints<Chain>) {
    const auto resting = [&] {
      if constexpr (Chain::reads_positions) {
        return only_positions{base, motion{zero3{}, no_rotation{}, zero3{}, zero3{}, zero3{}, zero3{}}};
      } else {
        return only_positions{base, motion{skip{}, skip{}, skip{}, zero3{}, zero3{}, zero3{}}};
      }
    }();
    const given<At, same<zero_t>, same<zero_t>, std::remove_const_t<decltype(resting)>, true> g{at, {}, {}, resting};
    if constexpr (is_unrolled<Chain, S>) {
      local_inverse_mass<S, Chain, std::remove_const_t<decltype(g)>>(c, g).invert(m);
    } else {
      m = inverse_mass_by_records<S>(c, g);
    }
  } else {
    auto factors = local_mass_matrix<S>(c, at, base);
    invert_by_factors(factors, m, [&at](int row) { blame_mass<typename Chain::wiring>(row, true, at.q); });
  }
  check_inverse<typename Chain::wiring>(m, at);
  return m;
}
}  // namespace detail

/// The inverse of the mass matrix, by the recursion of the articulated-body algorithm: column j is the acceleration
/// that a unit force on degree of freedom j makes in the chain at rest, without gravity and other forces. M itself is
/// formed (and factorised) only where coordinates follow others. q as for `inverse_dynamics`. Throws
/// `singular_mass_matrix`.
template <class Gravity, class... E, indexable Q>
auto mass_matrix_inverse(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  detail::check_configuration<chain_type>(q);
  const detail::configuration<S, typename chain_type::wiring, Q> at(q);
  return detail::inverse_mass<S>(c, at, detail::base_under_gravity(c));
}
/// The same at the positions of a state.
template <class Gravity, class... E, class S>
auto mass_matrix_inverse(const static_chain<Gravity, E...>& c, const chain_state<S, detail::wiring<E...>>& s) {
  const auto q = positions(s);
  const detail::configuration<S, detail::wiring<E...>, std::remove_const_t<decltype(q)>> at(q);
  return detail::inverse_mass<S>(c, at, detail::base_of_state<chain_state<S, detail::wiring<E...>>>{s});
}

}  // namespace kte
