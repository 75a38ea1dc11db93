#pragma once

#include <kte/dynamics/looped/forward_dynamics.hpp>
#include <kte/kernels/invert_general.hpp>
#include <kte/tree/fill_matrix.hpp>

/// Inverses of the mass matrix as loops over body nodes, for all `Elements` and states of
/// dynamics/looped/inverse_dynamics.hpp.
namespace kte::detail {

/// Derivatives of accelerations by forces with locked coordinates: the inverse of the other rows of M, and zeros.
template <class Elements, class State, class Matrix>
void invert_free_rows(const Elements& c, State& s, Matrix& inverse) {
  using S = typename State::scalar;
  mass_of_coordinates(c, s);
  auto& m = s.work.mass;
  for_each_held(c, s, [&m](int, int row) {
    m.row(row).setZero(), m.col(row).setZero();
    m(row, row) = S(1);
  });
  inverse.resize(s.dofs(), s.dofs());
  invert_by_factors(m, inverse, [&](int row) { c.diagnose_mass(s, row, true); });
  for_each_held(c, s, [&inverse](int, int row) { inverse(row, row) = S(0); });
}

/// The inverse with load-dependent friction: that of dtau/da, which is not symmetric.
template <class Elements, class State, class Matrix>
void invert_free_rows_with_friction(const Elements& c, State& s, const Matrix& by_a, Matrix& inverse) {
  using S = typename State::scalar;
  Matrix m = by_a;
  for_each_held(c, s, [&m](int, int row) {
    m.row(row).setZero(), m.col(row).setZero();
    m(row, row) = S(1);
  });
  if (!invert_general(m, inverse)) [[unlikely]]
    raise<no_solution>(
        "kte: accelerations do not follow smoothly from forces: load-dependent friction is "
        "about to jam");
  for_each_held(c, s, [&inverse](int, int row) { inverse(row, row) = S(0); });
}

/// The inverse of the mass matrix of a tree, after articulated inertias. Overwrites the loads.
template <class State, class Matrix>
void invert_articulated(State& s, Matrix& inverse) {
  using S = typename State::scalar;
  const auto& f = s.tree().body_tree;
  auto& w = s.work;
  tree::inverse_masses(f, w, w.masses);
  tree::fill_symmetric(f, s.dofs(), w.masses.rows, true, inverse);
  for (const int row : s.tree().plan.jointless_dofs)
    inverse(row, row) = S(1) / s.tree().own_mass[static_cast<std::size_t>(row)];
}
/// Articulated inertias of a tree at rest without forces.
template <class Elements, class State>
void articulate_at_rest(const Elements& c, State& s) {
  const auto& t = s.tree();
  auto& w = s.work;
  place_bodies(c, s);
  prescribe(s, {});
  if (const int bad = tree::articulate_at_rest(t.body_tree, w); bad >= 0) [[unlikely]]
    diagnose_axis(c, s, bad);
  check_jointless_masses(c, s);
}
/// The inverse of the mass matrix of a tree.
template <class Elements, class State, class Matrix>
void articulate_and_invert(const Elements& c, State& s, Matrix& inverse) {
  articulate_at_rest(c, s);
  invert_articulated(s, inverse);
}
/// The diagonal of the inverse, with time and memory linear in the number of axes times the depth of the tree.
template <class Elements, class State>
std::vector<typename State::scalar> inverse_mass_diagonal(const Elements& c, State& s) {
  using S = typename State::scalar;
  articulate_at_rest(c, s);
  const auto& f = s.tree().body_tree;
  std::vector<S> diagonal(static_cast<std::size_t>(s.dofs()));
  for (std::size_t i = 0; i < f.nodes.size(); ++i)
    for (int k = 0; f.nodes[i].is_free && k < f.nodes[i].axes; ++k)
      diagonal[static_cast<std::size_t>(f.row[static_cast<std::size_t>(f.nodes[i].first + k)])] =
          tree::inverse_mass_of_axis(f, s.work, i, k);
  for (const int row : s.tree().plan.jointless_dofs)
    diagonal[static_cast<std::size_t>(row)] = S(1) / s.tree().own_mass[static_cast<std::size_t>(row)];
  return diagonal;
}

}  // namespace kte::detail
