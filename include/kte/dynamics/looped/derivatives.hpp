#pragma once

#include <kte/dynamics/looped/mass_matrix.hpp>
#include <kte/tree/variations.hpp>

/// Derivatives of inverse dynamics as loops over body nodes, for all `Elements` and states of
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// Writes the derivatives of the generalized forces to `of_forces`, except tau; call `forces_on_coordinates` first.
template <class Elements, class State>
void derive_forces(const Elements& c, State& s) {
  using S = typename State::scalar;
  const auto& f = s.tree().body_tree;
  auto& w = s.work;
  auto& r = w.of_forces;
  const Eigen::Index n = s.dofs();
  // Chains of bodies only always write the same entries; the others stay zero.
  if (!s.tree().only_bodies || r.by_a.rows() != n) r.by_q.setZero(n, n), r.by_v.setZero(n, n), r.by_a.setZero(n, n);
  w.variations.axes.resize(f.axes()), w.variations.bodies.resize(f.slots());
  place_in_world(s);
  tree::start_variations(f, w, w.variations);
  S *const q = r.by_q.data(), *const v = r.by_v.data(), *const a = r.by_a.data();
  const int* const row = f.row.data();
  const bool by_axes = f.in_order && static_cast<Eigen::Index>(f.axes()) == n, shared = !s.tree().plan.tree;
  tree::vary_forces(f, w, w.variations,
                    [=](int j, int k, const S& by_q, const S& by_v, const S& by_a) KTE_INLINE_LAMBDA {
                      Eigen::Index at = k * n + j;
                      if (!by_axes) {
                        if (row[j] >= n || row[k] >= n) return;  // a prescribed coordinate
                        at = row[k] * n + row[j];
                        if (shared) {  // joints share a coordinate
                          q[at] += by_q, v[at] += by_v, a[at] += by_a;
                          return;
                        }
                      }
                      q[at] = by_q, v[at] = by_v, a[at] = by_a;
                    });
  for (const auto& [coordinate, mass] : s.tree().rotors)
    if (const int at = s.tree().plan.row_of_gen[static_cast<std::size_t>(coordinate)]; at < n) r.by_a(at, at) += mass;
  for (const int e : s.tree().on_coordinates) c.derive(e, s);
}

}  // namespace kte::detail
