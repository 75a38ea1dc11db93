#pragma once

#include <kte/dynamics/bias_forces.hpp>
#include <kte/dynamics/detail/runtime_bodies.hpp>

/// Bodies of runtime chains: bias forces, kinetic energy, centre of mass, momentum, under the names they have on static
/// chains (dynamics/bias_forces.hpp, energy.hpp, centre_of_mass.hpp, centroidal.hpp). Bases stand and are accelerated
/// as the state has them, and otherwise rest, but those that elements move as signals say. Nothing is allocated but the
/// matrix that `centroidal_map` returns.
namespace kte {

/// As on static chains. The state keeps its velocities and accelerations.
template <class S>
const runtime_vector<S>& static_forces(const kte_map_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::check_positions(s);
  const detail::rates_aside aside(s, true);
  return inverse_dynamics(c, s);
}
template <class S>
const runtime_vector<S>& gravity_forces(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  const detail::rates_aside aside(s, true);
  detail::forces_of_bodies(c, s, true);
  return detail::applied_forces(s);
}
template <class S>
const runtime_vector<S>& nonlinear_effects(const kte_map_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::check_state_velocities(s);
  const detail::rates_aside aside(s, false);
  return inverse_dynamics(c, s);
}
template <class S>
const runtime_vector<S>& coriolis_forces(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_state_velocities(s);
  const detail::rates_aside aside(s, false);
  detail::forces_of_bodies(c, s, false);
  return detail::applied_forces(s);
}

/// After doMotion, J.
template <class S>
S kinetic_energy(const kte_map_chain& c, basic_runtime_state<S>& s) {
  c.check(s), detail::check_state_velocities(s);
  c.doMotion(s);
  static_assert(detail::goes_through_passes<S>);
  double sum = 0;
  for (const auto& e : c.wiring().elements) sum += e.element->kinetic_energy(s);
  return detail::checked_energy<S>(sum, detail::blame_state{"an energy", s});
}
/// Of springs, and of all bodies under the chain's gravity: zero at the origin. J.
template <class S>
S potential_energy(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  c.doMotion(s);
  static_assert(detail::goes_through_passes<S>);
  double sum = 0;
  for (const auto& e : c.wiring().elements) {
    sum += e.element->potential_energy(s);
    if (e.spreads) sum -= dot(c.gravity(), e.element->first_moment(s));
  }
  detail::carry_bodies(c, s);
  return detail::checked_energy<S>(sum - dot(c.gravity(), tree::weight_in_world(s.tree().forest, s.work).moment),
                                   detail::blame_state{"an energy", s});
}
template <class S>
energies<S> energy(const kte_map_chain& c, basic_runtime_state<S>& s) {
  const S kinetic = kinetic_energy(c, s);
  return {kinetic, potential_energy(c, s)};
}

/// By composite inertias, with those of the mass matrix.
template <class S>
mass_centre<S> centre_of_mass(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  detail::carry(c, s);
  const auto w = tree::weight_in_world(s.tree().forest, s.work);
  return {w.mass, detail::divided_by_mass<S>(w.mass, w.moment, detail::blame_state{"a centre of mass", s})};
}
template <class S>
vec3<S> centre_of_mass_velocity(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  return detail::divided_by_mass<S>(tree::weight_in_world(s.tree().forest, s.work).mass,
                                    detail::momentum_of_coordinates(s, vec3<S>{}).force,
                                    detail::blame_state{"a velocity", s});
}
template <class S>
linear_angular<S> centroidal_momentum(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_state_velocities(s);
  detail::carry(c, s);
  const auto w = tree::weight_in_world(s.tree().forest, s.work);
  const detail::blame_state why{"a momentum", s};
  const auto h = detail::momentum_of_coordinates(s, detail::divided_by_mass<S>(w.mass, w.moment, why));
  return detail::checked<S>(h.force, h.torque, why);
}
namespace detail {
/// At positions that are good.
template <class S>
basic_runtime_jacobian<S> centroidal_map_of(const kte_map_chain& c, basic_runtime_state<S>& s) {
  carry(c, s);
  const auto w = tree::weight_in_world(s.tree().forest, s.work);
  basic_runtime_jacobian<S> a = basic_runtime_jacobian<S>::Zero(6, s.tree().plan.coordinates);
  const blame_state why{"a momentum", s};
  for_each_momentum(s, divided_by_mass<S>(w.mass, w.moment, why), [&a](int row, const tree::dense_wrench<S>& h) {
    auto column = a.col(row);
    column[0] += h.force.x, column[1] += h.force.y, column[2] += h.force.z;
    column[3] += h.torque.x, column[4] += h.torque.y, column[5] += h.torque.z;
  });
  check_result(a.data(), static_cast<std::size_t>(a.size()), why);
  if (a.cols() == s.dofs()) return a;
  return folded(c, s, std::move(a));
}
}  // namespace detail
template <class S>
basic_runtime_jacobian<S> centroidal_map(const kte_map_chain& c, basic_runtime_state<S>& s) {
  detail::check_regular(c, s), detail::check_positions(s);
  return detail::centroidal_map_of(c, s);
}

// The same at q, or q and v, which are put into the state.
template <class S, indexable Q>
const runtime_vector<S>& static_forces(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& { return static_forces(c, s); });
}
template <class S, indexable Q>
const runtime_vector<S>& gravity_forces(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&]() -> const auto& { return gravity_forces(c, s); });
}
template <class S, indexable Q, indexable V>
const runtime_vector<S>& nonlinear_effects(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&]() -> const auto& {
    return nonlinear_effects(c, s);
  });
}
template <class S, indexable Q, indexable V>
const runtime_vector<S>& coriolis_forces(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&]() -> const auto& {
    return coriolis_forces(c, s);
  });
}
template <class S, indexable Q, indexable V>
S kinetic_energy(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&] { return kinetic_energy(c, s); });
}
template <class S, indexable Q>
S potential_energy(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take<detail::keeping::if_needed>(c, s, q).call([&] { return potential_energy(c, s); });
}
template <class S, indexable Q, indexable V>
energies<S> energy(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take<detail::keeping::if_needed>(c, s, q, v).call([&] { return energy(c, s); });
}
template <class S, indexable Q>
mass_centre<S> centre_of_mass(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  return detail::take(c, s, q).call([&] { return centre_of_mass(c, s); });
}
template <class S, indexable Q, indexable V>
vec3<S> centre_of_mass_velocity(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take(c, s, q, v).call([&] { return centre_of_mass_velocity(c, s); });
}
template <class S, indexable Q, indexable V>
linear_angular<S> centroidal_momentum(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q, const V& v) {
  return detail::take(c, s, q, v).call([&] { return centroidal_momentum(c, s); });
}
template <class S, indexable Q>
basic_runtime_jacobian<S> centroidal_map(const kte_map_chain& c, basic_runtime_state<S>& s, const Q& q) {
  detail::check_regular(c, s);
  return detail::take(c, s, q).call([&] { return detail::centroidal_map_of(c, s); });
}

#ifdef KTE_EXTERN
KTE_EXTERN template const runtime_vector<double>& static_forces(const kte_map_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& gravity_forces(const kte_map_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& nonlinear_effects(const kte_map_chain&, runtime_state&);
KTE_EXTERN template const runtime_vector<double>& coriolis_forces(const kte_map_chain&, runtime_state&);
KTE_EXTERN template double kinetic_energy(const kte_map_chain&, runtime_state&);
KTE_EXTERN template double potential_energy(const kte_map_chain&, runtime_state&);
KTE_EXTERN template mass_centre<double> centre_of_mass(const kte_map_chain&, runtime_state&);
KTE_EXTERN template vec3<> centre_of_mass_velocity(const kte_map_chain&, runtime_state&);
KTE_EXTERN template linear_angular<double> centroidal_momentum(const kte_map_chain&, runtime_state&);
KTE_EXTERN template runtime_jacobian centroidal_map(const kte_map_chain&, runtime_state&);
namespace detail {
KTE_EXTERN template runtime_jacobian centroidal_map_of(const kte_map_chain&, runtime_state&);
}  // namespace detail
#endif

}  // namespace kte
