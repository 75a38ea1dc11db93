#pragma once

#include <kte/dynamics/looped/inverse_dynamics.hpp>

/// Distributed masses in the loops over body nodes. `Elements` and states as in dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// The forces of distributed masses on the degrees of freedom, at rest, under the accelerations of the state.
template <class Elements, class State>
void forces_of_distributed_masses(const Elements& c, State& s) {
  const auto& t = s.tree();
  auto& w = s.work;
  bring_up_to_date(c, s);
  take_rates(s);
  for (std::size_t b = 0; b < static_cast<std::size_t>(t.body_tree.bases); ++b) w.bodies[b] = {};
  tree::move_bodies<true>(t.body_tree, w);
  place_touched_frames(s, true);
  clear_coordinates(s);
  for (const int e : t.distributed) c.mass_loads(e, s);
  take_frame_loads(s);
  tree::transmit_loads(t.body_tree, w);
  for (const auto& r : t.body_tree.nodes)
    each_axis<vector_of::f>(s, r, [&w](auto& f, std::size_t k) { f -= w.force[k]; });
  push_on_coordinates(c, s, acting::bodies);
}
/// Their contribution to the mass matrix, by columns: the forces due to unit accelerations,
///
///   M = sum J^T M_e J          (1)
///
/// with M_e of an element over its ports. Call `place_bodies` first.
template <class Elements, class State, class Matrix>
void add_distributed_masses(const Elements& c, State& s, Matrix& m) {
  using S = typename State::scalar;
  std::vector<S> kept(2 * static_cast<std::size_t>(s.dofs()));
  const rates_aside aside(s, true, kept);
  place_in_world(s);
  Eigen::Matrix<S, Eigen::Dynamic, 1> a = Eigen::Matrix<S, Eigen::Dynamic, 1>::Zero(s.dofs()), none(s.dofs()),
                                      f(s.dofs());
  const auto forces_at = [&](auto& forces) {
    for_each_listed_freedom(s, [&](auto& x, const freedom& at) { put<vector_of::a>(x, at, a); });
    forces_of_distributed_masses(c, s);
    read_listed_numbers<vector_of::f>(s, forces);
  };
  forces_at(none);  // not zero if a motion is prescribed
  for (int j = 0; j < s.dofs(); ++j) {
    a[j] = S(1);
    forces_at(f);
    for (int i = j; i < s.dofs(); ++i) {  // the other triangle differs by rounding only
      const S mass = none[i] - f[i];
      m(i, j) += mass;
      if (i != j) m(j, i) += mass;
    }
    a[j] = S(0);
  }
}

}  // namespace kte::detail
