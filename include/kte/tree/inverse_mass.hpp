#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/columns.hpp>
#include <kte/tree/composite.hpp>

#include <vector>

namespace kte::tree {

/// What the inverse of the mass matrix works with.
template <class S>
struct inverse_memory {
  wrench_columns<S> loads;  ///< W of every axis that is reached
  std::vector<S> left;      ///< e_lk of one l
};

/// The inverse of the mass matrix from articulated inertias. A unit force on axis k leaves e_lk on axis l of its own
/// and of all bodies it stands on: with W the load that goes in, at first none,
///
///   e_kk = 1,   e_lk = s_l . W,   W -= gain_l e_lk          (1)
///   M^-1 = E^T D^-1 E                                       (2)
///
/// symmetric and positive by its form. (Jain, Robot and Multibody Dynamics, 2011, section 7.2.) Bodies from the last:
/// all W of axes beyond a body pass through it together. Into rows over axes as by `masses`. After `place_in_world`,
/// `articulate`, whose gains are then in world axes; of joints that all yield or rest.
template <class P, class S>
void inverse_masses(const forest<P>& f, memory<P, S>& m, inverse_memory<S>& x, S* rows) {
  const std::size_t bases = static_cast<std::size_t>(f.bases), n = f.axes();
  x.loads.resize(n), x.left.resize(n);
  const wrench_rows<S> w = x.loads.rows();
  S* const left = x.left.data();
  for (std::size_t i = f.records.size(); i-- > 0;) {
    const record<P>& r = f.records[i];
    const world_place<S>& place = m.world[bases + i];
    const auto first = static_cast<std::size_t>(r.first), end = first + static_cast<std::size_t>(r.axes),
               last = static_cast<std::size_t>(r.last);
    for (std::size_t l = end; l-- > first;) {
      if (!m.yields[i]) {
        w.set(l, {});
        continue;
      }
      axis_answer<S>& own = m.answers[l];
      own.gain = {place.rotation * own.gain.force, place.rotation * own.gain.torque};
      const dense_wrench<S> gain = own.gain;
      const world_axis<S> s = m.axes[l];
      const bool turns = r.moves == joint::revolute;
      left[l] = S(1);
      w.set(l, {-gain.force, -gain.torque});
      by_fours(l + 1, last, [&]<std::size_t N>(std::size_t k) KTE_INLINE_LAMBDA {  // (1)
        const auto e = w.template power<N>(s, turns, k);
        store(e, left + k);
        const auto give = [&e, k](S* component, const S& by) KTE_INLINE_LAMBDA {
          auto sum = several<N>(component + k);
          for (std::size_t c = 0; c < N; ++c) sum[c] -= by * e[c];
          store(sum, component + k);
        };
        give(w.fx, gain.force.x), give(w.fy, gain.force.y), give(w.fz, gain.force.z);
        give(w.tx, gain.torque.x), give(w.ty, gain.torque.y), give(w.tz, gain.torque.z);
      });
      for (std::size_t j = l; j < last; ++j) {  // (2)
        const S rate = own.inverse * left[j];
        S* const row = &rows[j * n];
        by_fours(j, last, [&]<std::size_t N>(std::size_t k) KTE_INLINE_LAMBDA {
          auto sum = several<N>(row + k);
          const auto e = several<N>(left + k);
          for (std::size_t c = 0; c < N; ++c) sum[c] += rate * e[c];
          store(sum, row + k);
        });
      }
    }
    if (r.parent >= f.bases) w.shift(first, last, place.step);
  }
}

}  // namespace kte::tree
