#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/composite.hpp>

#include <array>
#include <vector>

namespace kte::tree {

/// What the inverse of the mass matrix works with: by axis, padded to fours.
template <class S>
struct inverse_memory {
  std::vector<S> left;   ///< e_lk at l n + k
  std::vector<S> rates;  ///< e_lk / D_l of one k, and the l for which there is one
  std::vector<int> way;
};

/// The inverse of the mass matrix from articulated inertias. A unit force on axis k leaves e_lk on axis l of its own
/// and of all bodies it stands on: with W the load that goes in, at first none,
///
///   e_kk = 1,   e_lk = s_l . W,   W -= gain_l e_lk          (1)
///   M^-1 = E^T D^-1 E                                       (2)
///
/// symmetric and positive by its form. (Jain, Robot and Multibody Dynamics, 2011, section 7.2.) put(j, k, x) for
/// j <= k. After `place_in_world`, `articulate`, whose gains are then in world axes; of joints that all yield or rest.
template <class P, class S, class Put>
void inverse_masses(const forest<P>& f, memory<P, S>& m, inverse_memory<S>& x, const Put& put) {
  const int bases = f.bases;
  const record<P>* const records = f.records.data() - bases;  // by slot
  const char* const yields = m.yields.data() - bases;
  const std::size_t n = (f.axes() + 3) / 4 * 4;
  x.left.assign(n * n, S(0)), x.rates.resize(n), x.way.resize(n);
  S* const left = x.left.data();
  const int slots = static_cast<int>(f.slots());
  for (int slot = bases; slot < slots; ++slot) {
    const record<P>& r = records[slot];
    if (!yields[slot]) continue;
    const mat3<vec3<S>>& rotation = m.world[static_cast<std::size_t>(slot)].rotation;
    for (int k = r.first; k < r.first + r.axes; ++k) {
      auto& own = m.answers[static_cast<std::size_t>(k)];
      own.gain = {rotation * own.gain.force, rotation * own.gain.torque};
      std::size_t steps = 0;
      const auto leave = [&](int l, const S& e) {
        left[static_cast<std::size_t>(l) * n + static_cast<std::size_t>(k)] = e;
        x.rates[steps] = e * m.answers[static_cast<std::size_t>(l)].inverse, x.way[steps] = l;
        ++steps;
      };
      leave(k, S(1));
      dense_wrench<S> w{-own.gain.force, -own.gain.torque};
      for (int in = slot, l = k;;) {
        while (l-- > records[in].first) {
          const auto& [gain, rate, inverse] = m.answers[static_cast<std::size_t>(l)];
          const S e = power_in_world(records[in], m.axes[static_cast<std::size_t>(l)], w);
          leave(l, e);
          w = {w.force - e * gain.force, w.torque - e * gain.torque};
        }
        do {  // what does not yield hands all of it on
          if (records[in].parent < bases) {
            in = -1;
            break;
          }
          w.torque = w.torque + cross(m.world[static_cast<std::size_t>(in)].step, w.force);
          in = records[in].parent;
        } while (!yields[in]);
        if (in < 0) break;
        l = records[in].first + records[in].axes;
      }
      for (int j = 0; j <= k; j += 4) {  // (2)
        std::array<S, 4> sum{};
        for (std::size_t i = 0; i < steps; ++i) {
          const S* const row = left + static_cast<std::size_t>(x.way[i]) * n + static_cast<std::size_t>(j);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += x.rates[i] * row[c];
        }
        for (int c = 0; c < 4 && j + c <= k; ++c) put(j + c, k, sum[static_cast<std::size_t>(c)]);
      }
    }
  }
}

}  // namespace kte::tree
