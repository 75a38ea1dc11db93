#pragma once

#include <kte/dynamics/runtime/bodies.hpp>
#include <kte/dynamics/runtime/frames.hpp>
#include <kte/dynamics/unrolled/energy.hpp>
#include <kte/tree/kinetic_energy.hpp>

/// Energies of runtime chains: loops over bodies, or over elements after `doMotion`.
namespace kte::detail {

/// Whether the energies of a chain are those of the bodies of its tree, and of elements on coordinates.
template <class S>
bool energies_of_bodies(const basic_runtime_state<S>& s) {
  const auto& t = s.tree();
  return !t.irregular && !t.energy_on_frames && t.weights.empty() && t.distributed.empty() && t.late.empty();
}
/// Whether bodies that are fixed to a base move with it.
template <class S>
bool masses_on_bases_move(const basic_runtime_state<S>& s) {
  for (std::size_t b = 0; b < s.tree().body_tree.base_weight.size(); ++b) {
    const auto& x = s.work.bodies[b];
    if (s.tree().body_tree.base_weight[b].mass != 0 &&
        dot(x.velocity, x.velocity) + dot(x.ang_velocity, x.ang_velocity) != 0)
      return true;
  }
  return false;
}
/// By the passes: the motions of all frames.
template <class S>
S kinetic_energy_by_passes(const runtime_chain& c, basic_runtime_state<S>& s) {
  c.doMotion(s);
  S sum(0);
  for (const auto& e : c.wiring().elements) sum += e.element->kinetic_energy(s);
  return sum;
}
template <class S>
S potential_energy_by_passes(const runtime_chain& c, basic_runtime_state<S>& s) {
  c.doMotion(s);
  S sum(0);
  for (const auto& e : c.wiring().elements) {
    sum += e.element->potential_energy(s);
    if (e.distributed_mass) sum -= dot(c.gravity(), e.element->first_moment(s));
  }
  return sum - dot(c.gravity(), weigh(c, s).moment);
}
/// (1) at the present rates, for bodies that have their places.
template <class S>
S kinetic_energy_in_place(const runtime_chain& c, basic_runtime_state<S>& s) {
  take_rates(s), take_bases(s);
  if (masses_on_bases_move(s)) [[unlikely]]
    return kinetic_energy_by_passes(c, s);
  S sum = tree::kinetic_energy(s.tree().body_tree, s.work);
  for (const auto& [coordinate, mass] : s.tree().rotors) {
    const S& rate = s.template get<kind::gen>(coordinate).q_dot;
    sum += half(mass * (rate * rate));
  }
  for (const int e : s.tree().with_energy) sum += runtime_elements{c}.element(e).kinetic_energy(s);
  return sum;
}
/// (2), for bodies that have their places.
template <class S>
S potential_energy_in_place(const runtime_chain& c, basic_runtime_state<S>& s) {
  S sum(0);
  for (const int e : s.tree().with_energy) sum += runtime_elements{c}.element(e).potential_energy(s);
  return sum - dot(c.gravity(), weigh_in_place(s).moment);
}
/// Energies at checked positions and rates.
template <class S>
S kinetic_energy_at_state(const runtime_chain& c, basic_runtime_state<S>& s) {
  static_assert(goes_through_passes<S>);
  if (!energies_of_bodies(s)) return kinetic_energy_by_passes(c, s);
  place_bodies(runtime_elements{c}, s);
  return kinetic_energy_in_place(c, s);
}
template <class S>
S potential_energy_at_state(const runtime_chain& c, basic_runtime_state<S>& s) {
  static_assert(goes_through_passes<S>);
  if (!energies_of_bodies(s)) return potential_energy_by_passes(c, s);
  place_bodies(runtime_elements{c}, s);
  return potential_energy_in_place(c, s);
}
template <class S>
energies<S> energy_at_state(const runtime_chain& c, basic_runtime_state<S>& s) {
  const S kinetic = kinetic_energy_at_state(c, s);
  return {kinetic, energies_of_bodies(s) ? potential_energy_in_place(c, s) : potential_energy_by_passes(c, s)};
}
template <class S>
S finite_energy(const basic_runtime_state<S>& s, const S& energy) {
  return checked_energy<S>(energy, diagnose_state{"an energy", s});
}
template <class S>
energies<S> finite_energy(const basic_runtime_state<S>& s, const energies<S>& both) {
  return {finite_energy(s, both.kinetic), finite_energy(s, both.potential)};
}

#ifdef KTE_EXTERN
KTE_EXTERN template double kinetic_energy_at_state(const runtime_chain&, runtime_state&);
KTE_EXTERN template double potential_energy_at_state(const runtime_chain&, runtime_state&);
KTE_EXTERN template energies<double> energy_at_state(const runtime_chain&, runtime_state&);
#endif

}  // namespace kte::detail
