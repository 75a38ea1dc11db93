#pragma once

#include <kte/dynamics/configuration_space.hpp>
#include <kte/dynamics/inverse_dynamics.hpp>
#include <kte/dynamics/unrolled/given_bases.hpp>
#include <kte/math/dual.hpp>

namespace kte {

/// The generalized momenta,
///
///   p = M(q) v                    (1)
///
/// by the recursion of inverse dynamics, without forming M: dofs numbers, kg m/s and kg m^2/s. For rotations, p is an
/// angular momentum, and for poses a linear and an angular one, in axes of the moving frame. Arguments and errors are
/// those of `inverse_dynamics`.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto generalized_momenta(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  check_configuration<chain_type>(q), check_size<chain_type::dofs>(v, "v");
  const configuration<S, typename chain_type::wiring, Q> at(q);
  const with_loads<chain_type, masses_alone<true>> masses{c};
  constexpr same_base at_rest{motion{skip{}, skip{}, skip{}, zero3{}, zero3{}, zero3{}}};
  return generalized_forces<S>(masses, given{at, same<zero_t>{}, each<S, V>{v}, rest_base_of<chain_type>(at_rest)},
                               minus_one);
}

/// p of (1), and its time derivative at constant v:
///
///   M_dot v,   M_dot the derivative of M(q) along v            (2)
///
/// by dual numbers, exact to rounding.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto generalized_momenta_along(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto moving = detail::moving_along(c, q, v);
  const auto both = generalized_momenta(c, moving, v);
  std::pair<joint_vector<S, chain_type::dofs>, joint_vector<S, chain_type::dofs>> p;
  for (Eigen::Index i = 0; i < chain_type::dofs; ++i) p.first[i] = both[i].value, p.second[i] = both[i].derivative[0];
  return p;
}

}  // namespace kte
