#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/composite.hpp>

namespace kte::tree {

/// The inverse of the mass matrix from articulated inertias. A unit force on axis k leaves e_lk on axis l of its own
/// and of all bodies it stands on: with W the load that goes in, at first none,
///
///   e_kk = 1,   e_lk = s_l . W,   W -= gain_l e_lk          (1)
///   M^-1 = E^T D^-1 E                                       (2)
///
/// symmetric and positive by its form. (Jain, Robot and Multibody Dynamics, 2011, section 7.2.) put(j, k, x) for
/// j <= k. After `place_in_world`, `articulate`, whose gains are then in world axes; for chains in which all joints yield.
template <class P, class S, class Put>
KTE_INLINE void inverse_masses(const forest<P>& f, memory<P, S>& m, const Put& put) {
  const std::size_t bases = static_cast<std::size_t>(f.bases), n = f.axes();
  m.left.assign(2 * n * n, S(0));
  S* const left = m.left.data();       // e_lk at l n + k
  S* const sums = m.left.data() + n * n;
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const mat3<vec3<S>>& rotation = m.world[bases + i].rotation;
    for (int k = f.records[i].first; k < f.records[i].first + f.records[i].axes; ++k) {
      dense_wrench<S>& gain = m.answers[static_cast<std::size_t>(k)].gain;
      gain = {rotation * gain.force, rotation * gain.torque};
    }
  }
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    for (int k = r.first; k < r.first + r.axes; ++k) {
      if (!m.yields[i]) continue;
      dense_wrench<S> w{};
      int axis = k;
      std::size_t slot = bases + i;
      left[static_cast<std::size_t>(k) * n + static_cast<std::size_t>(k)] = S(1);
      S e = S(1);
      for (;;) {
        const dense_wrench<S>& gain = m.answers[static_cast<std::size_t>(axis)].gain;
        if (m.yields[slot - bases])
          w = {w.force - e * gain.force, w.torque - e * gain.torque};
        if (axis == f.records[slot - bases].first) {
          const int parent = f.records[slot - bases].parent;
          if (parent < f.bases) break;
          w.torque = w.torque + cross(m.world[slot].step, w.force);
          slot = static_cast<std::size_t>(parent);
          const record<P>& before = f.records[slot - bases];
          axis = before.first + before.axes;
        }
        --axis;
        e = m.yields[slot - bases] ? power(m.axes[static_cast<std::size_t>(axis)], w) : S(0);
        left[static_cast<std::size_t>(axis) * n + static_cast<std::size_t>(k)] = e;
      }
    }
  }
  for (std::size_t i = 0; i < f.records.size(); ++i) {
    const record<P>& r = f.records[i];
    if (!m.yields[i]) continue;
    for (int l = r.first; l < r.first + r.axes; ++l) {
      const S* const row = left + static_cast<std::size_t>(l) * n;
      for (int j = l; j < r.last; ++j) {
        const S x = m.answers[static_cast<std::size_t>(l)].inverse * row[j];
        S* const sum = sums + static_cast<std::size_t>(j) * n;
        for (int k = j; k < r.last; ++k) sum[k] += x * row[k];
      }
    }
  }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = j; k < n; ++k) put(static_cast<int>(j), static_cast<int>(k), sums[j * n + k]);
}

}  // namespace kte::tree
