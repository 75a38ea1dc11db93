#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/mass_memory.hpp>

namespace kte::tree {

/// The inverse of the mass matrix from articulated inertias. A unit force on axis k leaves e_lk on axis l of its body
/// and of all bodies before it. With W the load that passes inward, initially zero,
///
///   e_kk = 1,   e_lk = s_l . W,   W -= gain_l e_lk          (1)
///   M^-1 = E^T D^-1 E                                       (2)
///
/// It is symmetric and positive definite by construction (Jain, Robot and Multibody Dynamics, 2011, section 7.2). The
/// recursion is inward; all W of the axes beyond a body pass on together. The result is in rows over axes, each from
/// the diagonal on. Call `articulate` first; all joints must be free or all at rest.
template <class P, class S>
void inverse_masses(const body_tree<P>& f, const memory<P, S>& m, mass_memory<S>& x) {
  wrench_rows<S>& w = x.wrenches;
  collected_rows<S>& all = x.left;
  const int axes = static_cast<int>(f.axes());
  w.resize(f.axes()), x.rows.resize(f.axes(), f.axes()), all.resize(f.axes());
  all.begin(axes, axes);
  for (std::size_t i = f.nodes.size(); i-- > 0;) {
    const body_node<P>& r = f.nodes[i];
    const joint_transform<S>& at = m.joint_transforms[i];
    const axis_factors<S>* const factors = &m.factors[static_cast<std::size_t>(r.first)];
    const bool on_base = r.parent < f.bases, is_free = m.is_free[i] != 0;
    if (r.last != all.last()) {
      all.sum_up(x.rows);
      all.begin(r.first + r.axes, r.last);
    } else if (!all.has_room(r.axes)) {
      all.sum_up(x.rows);
    }
    all.go_to(r.first);
    if (!r.has_matrix() && is_free) {
      const dense_wrench<S> gain = factors[0].gain;
      S* const left = all.add(r.first, factors[0].inverse);
      w.change(r.first, r.last, [&](simd_wrench<S>& load, int k) KTE_INLINE_LAMBDA {  // (1)
        simd<S> e;
        if (k <= r.first) load.put(simd_lane<S>(r.first - k), {});
        load.power_on(r, e);
        if (k <= r.first) simd_lane<S>(r.first - k).put(e, S(1));
        store<S>(e, left + k);
        if (on_base) return;
        load.subtract(gain, e);
        load.go_in(r, at);
      });
    } else {
      for (int k = r.first; k < r.first + r.axes; ++k) w.set(k, dense_wrench<S>{});
      for (int l = r.first + r.axes; is_free && l-- > r.first;) {
        S* const left = all.add(l, factors[l - r.first].inverse);
        std::fill(left + r.first, left + l, S(0));
        if (const S* const power = w.powers_on(r, at, l - r.first, l, r.last, left); power != left)
          for_each_simd_to<S>(r.last, l, [&](int k) KTE_INLINE_LAMBDA {
            simd<S> e;
            tree::load<S>(e, power + k), store<S>(e, left + k);
          });
        left[l] = S(1);
        w.change(l, r.last, [&](simd_wrench<S>& load, int k) KTE_INLINE_LAMBDA {
          simd<S> e;
          tree::load<S>(e, left + k);
          load.subtract(factors[l - r.first].gain, e);
        });
      }
      if (!on_base) w.change(r.first, r.last, [&](simd_wrench<S>& load, int) KTE_INLINE_LAMBDA { load.go_in(r, at); });
    }
    // What axes of other bodies have in common with those from here on is still to come, if anything is.
    const int beside = on_base ? axes : f.nodes[static_cast<std::size_t>(r.parent - f.bases)].last;
    for (int j = r.first; r.last < beside && j < r.last; ++j) std::fill(x.rows[j] + r.last, x.rows[j] + beside, S(0));
  }
  all.sum_up(x.rows);
}

/// The diagonal entry of M^-1 for axis `k` of body node `i`: by (2) the sum of e_lk D_l^-1 e_lk over the axes l from
/// there to the base, with e_lk computed one after the other by (1). Conditions as for `inverse_masses`.
template <class P, class S>
S inverse_mass_of_axis(const body_tree<P>& f, const memory<P, S>& m, std::size_t i, int k) {
  dense_wrench<S> load{};
  S sum(0);
  for (bool own = true;; own = false) {
    const body_node<P>& r = f.nodes[i];
    const joint_transform<S>& at = m.joint_transforms[i];
    for (int l = own ? k : r.axes - 1; m.is_free[i] && l >= 0; --l) {
      const axis_factors<S>& factor = m.factors[static_cast<std::size_t>(r.first + l)];
      const S e =
          own && l == k ? S(1) : with_axis(r, at, l, [&load](const auto& s) { return as<S>(engine::power(s, load)); });
      sum += factor.inverse * e * e;  // (2)
      load = {load.force - e * factor.gain.force, load.torque - e * factor.gain.torque};
    }
    if (r.parent < f.bases) return sum;
    load = placed{r, at}.out(load);
    i = static_cast<std::size_t>(r.parent - f.bases);
  }
}

}  // namespace kte::tree
