#ifndef KTE_CENTRE_OF_MASS_HPP
#define KTE_CENTRE_OF_MASS_HPP

#include <kte/dynamics/unrolled/mass_properties.hpp>

namespace kte {

/// A `mass`, kg, and the `position` of its centre, m.
template <class S = double>
struct mass_centre {
  S mass;
  vec3<S> position;
};

/// The mass of all bodies, kg, and their centre of mass, m, in axes of the base, from its origin. With the first moment
/// h = m c of the subtree of a frame,
///
///   c = h_base / m                                       (1)
///   h_base += R h_end + m_end p,  m_base += m_end        (2)
///
/// from the tips to the base, for a link or joint with R, p between base and end. Runtime chains: `centre_of_mass(c, s,
/// q)`, or `centre_of_mass(c, s)` at the positions of the state s, in axes of the world. Arguments and errors as for
/// `inverse_dynamics`. Throws `bad_argument` also for a mass of zero, and for distributed masses.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto centre_of_mass(const static_chain<Gravity, E...>& c, const Q& q) {
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  const auto x = detail::checked_arguments<chain_type>(q);
  const auto w = detail::weight_of<S>(c, x.at);
  return mass_centre<S>{as<S>(w.mass), detail::divided_by_mass<S>(w.mass, w.moment, x.diagnosis("a centre of mass"))};
}

/// The velocity of the centre of mass, m/s, in axes of the base, with bases at rest: momentum over mass. Runtime
/// chains: `centre_of_mass_velocity(c, s, q, v)` or `(c, s)`, with the motion of bases that elements move by signals.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto centre_of_mass_velocity(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  static_assert(sizeof(detail::check_bodies_of<chain_type>) > 0);
  const auto x = checked_arguments<chain_type>(q, v);
  return divided_by_mass<S>(weight_of<S>(c, x.at).mass, momentum_at_base<S>(c, x.at, x.v).force,
                            x.diagnosis("a velocity"));
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_CENTRE_OF_MASS_OF_RUNTIME_CHAINS)
#define KTE_CENTRE_OF_MASS_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/bodies.hpp>

namespace kte {

template <class S>
mass_centre<S> centre_of_mass(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_positions(s);
  detail::refuse_distributed_masses(c, s);
  const auto w = detail::weigh(c, s);
  return {w.mass, detail::divided_by_mass<S>(w.mass, w.moment, detail::diagnose_state{"a centre of mass", s})};
}
template <class S>
vec3<S> centre_of_mass_velocity(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  return detail::divided_by_mass<S>(tree::weight_in_world(s.tree().body_tree, s.work).mass,
                                    detail::momentum_of_coordinates(s, vec3<S>{}).force,
                                    detail::diagnose_state{"a velocity", s});
}
template <class S, indexable Q>
mass_centre<S> centre_of_mass(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take(c, s, q).call([&] { return centre_of_mass(c, s); });
}
template <class S, indexable Q, indexable V>
vec3<S> centre_of_mass_velocity(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take(c, s, q, v).call([&] { return centre_of_mass_velocity(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template mass_centre<double> centre_of_mass(const runtime_chain&, runtime_state&);
KTE_EXTERN template vec3<> centre_of_mass_velocity(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte

#endif
