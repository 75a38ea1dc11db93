#pragma once

#include <kte/tree/composite.hpp>
#include <kte/tree/inverse_mass.hpp>
#include <kte/tree/ratios.hpp>

namespace kte::tree {

/// Working memory of `followed_masses`, in addition to `mass_memory`. The columns of bodies whose parents are still to
/// come are contiguous, those of the last body at the end.
template <class S>
struct followed_memory {
  ratios<S> j;
  std::vector<int> dof;    ///< by column
  std::vector<int> place;  ///< by degree of freedom: its column for the current body, if there is one
  std::vector<int> first;  ///< by body node: its first column; -1: none yet
};

/// The mass matrix by degrees of freedom for chains with dependent coordinates, in one pass over bodies: the
/// composite-rigid-body algorithm with one wrench for every degree of freedom d that moves something beyond a body,
/// instead of one for every axis,
///
///   F_d = sum_k J_kd F_k,   M_cd = sum_j J_jc s_j . F_d, twice where k is beyond j          (1)
///
/// so that neither time nor memory grow with the square of the number of axes. Writes m; call `carry_bodies` first.
template <class P, class S, class Matrix>
void followed_masses(const body_tree<P>& f, const memory<P, S>& at, int dofs, followed_memory<S>& x, mass_memory<S>& y,
                     Matrix& m) {
  std::size_t columns = 0;
  for (const int row : f.row) columns += x.j.of(row).size();
  constexpr std::size_t most_axes = 6;  // of a joint; its wrenches are temporarily stored after the columns
  wrench_rows<S>& w = y.wrenches;
  w.resize(columns + most_axes), y.rows.resize(1, columns + most_axes);
  x.dof.resize(columns), x.place.assign(static_cast<std::size_t>(dofs), -1), x.first.assign(f.nodes.size(), -1);
  m.setZero(dofs, dofs);
  S* const masses = m.data();
  const auto put = [masses, dofs](std::ptrdiff_t c, std::ptrdiff_t d, const S& mass)
                       KTE_INLINE_LAMBDA { masses[c + d * dofs] += mass; };
  int *const dof = x.dof.data(), *const place = x.place.data();
  int last = 0;
  for (const int i : f.inward) {
    const body_node<P>& r = f.nodes[static_cast<std::size_t>(i)];
    const int beyond = x.first[static_cast<std::size_t>(i)], first = beyond < 0 ? last : beyond;
    const auto add = [&](int d, const dense_wrench<S>& load) {
      int& k = place[d];
      if (k >= first && k < last && dof[k] == d) {
        const dense_wrench<S> before = w.get(k);
        w.set(k, {before.force + load.force, before.torque + load.torque});
      } else {
        k = last++;
        dof[k] = d, w.set(k, load);
      }
    };
    if (r.branches) {  // siblings on this body may follow the same degree of freedom
      const int end = last;
      last = first;
      for (int k = first; k < end; ++k) add(dof[k], w.get(k));
    }
    const int own = last;
    const joint_transform<S>& transform = at.joint_transforms[static_cast<std::size_t>(i)];
    for (int a = 0; a < r.axes; ++a)
      w.set(own + a, accelerating(r, transform, a, at.carried[static_cast<std::size_t>(f.bases + i)]));
    const auto ratios_of = [&](int a) { return x.j.of(f.row[static_cast<std::size_t>(r.first + a)]); };
    for (int a = 0; a < r.axes; ++a) {
      const S* const power = w.powers_on(r, transform, a, first, own + r.axes, y.rows[0]);
      for (const auto& [c, ratio] : ratios_of(a))  // (1)
        for (int k = first; k < own; ++k) {
          const S mass = ratio * power[k];
          put(c, dof[k], mass), put(dof[k], c, mass);
        }
      for (int b = 0; b < r.axes; ++b)
        for (const auto& [c, ratio] : ratios_of(a))
          for (const auto& [d, factor] : ratios_of(b)) put(c, d, ratio * factor * power[own + b]);
    }
    if (r.parent < f.bases) {
      last = first;
      continue;
    }
    for (int a = 0; a < r.axes; ++a) {  // each of several axes has one column, new or shared with an earlier axis
      const dense_wrench<S> load = w.get(own + a);
      for (const auto& [d, ratio] : ratios_of(a)) add(d, {ratio * load.force, ratio * load.torque});
    }
    w.change_from(first, last, [&](simd_wrench<S>& load, int) KTE_INLINE_LAMBDA { load.go_in(r, transform); });
    int& of_parent = x.first[static_cast<std::size_t>(r.parent - f.bases)];
    if (of_parent < 0) of_parent = first;
  }
}

}  // namespace kte::tree
