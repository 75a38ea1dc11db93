#ifndef KTE_ENERGY_HPP
#define KTE_ENERGY_HPP

#include <kte/dynamics/centre_of_mass.hpp>
#include <kte/dynamics/unrolled/energy.hpp>

namespace kte {

/// The kinetic energy of all bodies and of masses on coordinates, with bases at rest, J:
///
///   T = sum m |v_c|^2 / 2 + w . I w / 2 + sum m q_dot^2 / 2  =  v . M(q) v / 2          (1)
///
/// by the velocities of frames, without M: a sum of terms that are not negative, without cancellation. Runtime chains:
/// `kinetic_energy(c, s, q, v)`, or `kinetic_energy(c, s)` at the positions and rates of the state s, with the motion
/// of its bases: a loop over bodies, or for chains with forces on frames or masses between frames `doMotion` and a loop
/// over elements. Arguments and errors as for `inverse_dynamics`.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto kinetic_energy(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v);
  return checked_energy<S>(kinetic_energy_at<S>(c, x.at, x.v), x.diagnosis("an energy"));
}

/// The potential energy of gravity, zero with the centre of mass at the origin of the base, and of all springs, J:
///
///   V = - gravity . sum m c + sum V_spring          (2)
///
/// Elements contribute by a function `potential_energy`; dampers and motors have none. Runtime chains:
/// `potential_energy(c, s, q)`, or `potential_energy(c, s)`.
template <class Gravity, class... E, indexable Q>
[[nodiscard]] auto potential_energy(const static_chain<Gravity, E...>& c, const Q& q) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q);
  return checked_energy<S>(potential_energy_at<S>(c, x.at), x.diagnosis("an energy"));
}

/// Kinetic and potential energy, J. Their sum is constant if no other force does work.
template <class Gravity, class... E, indexable Q, indexable V>
[[nodiscard]] auto energy(const static_chain<Gravity, E...>& c, const Q& q, const V& v) {
  using namespace detail;
  using chain_type = static_chain<Gravity, E...>;
  using S = value_of<Q>;
  const auto x = checked_arguments<chain_type>(q, v);
  const auto why = x.diagnosis("an energy");
  return energies<S>{checked_energy<S>(kinetic_energy_at<S>(c, x.at, x.v), why),
                     checked_energy<S>(potential_energy_at<S>(c, x.at), why)};
}

}  // namespace kte

#endif

// ---- of runtime chains (kte/runtime_chain.hpp)

#if defined(KTE_RUNTIME_CHAINS) && !defined(KTE_ENERGY_OF_RUNTIME_CHAINS)
#define KTE_ENERGY_OF_RUNTIME_CHAINS

#include <kte/dynamics/runtime/energies.hpp>

namespace kte {

template <class S>
S kinetic_energy(const runtime_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::check_state_velocities(s);
  return detail::finite_energy(s, detail::kinetic_energy_at_state(c, s));
}
template <class S>
S potential_energy(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_positions(s);
  return detail::finite_energy(s, detail::potential_energy_at_state(c, s));
}
template <class S>
energies<S> energy(const runtime_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular_tree(c, s), detail::check_state_velocities(s);
  return detail::finite_energy(s, detail::energy_at_state(c, s));
}
template <class S, indexable Q, indexable V>
S kinetic_energy(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&] {
    return detail::finite_energy(s, detail::kinetic_energy_at_state(c, s));
  });
}
template <class S, indexable Q>
S potential_energy(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular_tree(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q).call(
      [&] { return detail::finite_energy(s, detail::potential_energy_at_state(c, s)); });
}
template <class S, indexable Q, indexable V>
energies<S> energy(const runtime_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  detail::check_regular_tree(c, s);
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&] {
    return detail::finite_energy(s, detail::energy_at_state(c, s));
  });
}

}  // namespace kte

#endif
