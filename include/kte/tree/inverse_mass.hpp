#pragma once

#include <kte/tree/articulated.hpp>
#include <kte/tree/columns.hpp>

#include <type_traits>

namespace kte::tree {

/// Sums of products of rows, collected up to `most` at a time: for the axes l of a limb,
///
///   x_jk += sum_l D_l^-1 e_lj e_lk       from the first axis of the body of l on          (1)
///
/// Sums are stored less often than for one row at a time.
template <class S>
class collected_rows {
 public:
  static constexpr int most = 8;
  void resize(std::size_t axes) { left_.resize(most, axes); }
  /// Begins a limb whose last axis is `last` - 1; axes from `known` on have sums.
  void begin(int known, int last) { first_ = known_ = known, last_ = last; }
  int last() const { return last_; }
  bool has_room(int axes) const { return count_ + axes <= most; }
  /// Goes on to a body whose first axis is `first`.
  void go_to(int first) { first_ = first; }
  /// The next row: of axis l, before those of earlier rows.
  S* add(int l, const S& factor) {
    axis_[static_cast<std::size_t>(count_)] = l, factor_[static_cast<std::size_t>(count_)] = factor;
    return left_[count_++];
  }
  /// (1)
  void sum_up(axis_rows<S>& sums) {
    int l = count_;
    for (int j = first_; j < last_; ++j) {
      while (l > 0 && axis_[static_cast<std::size_t>(l - 1)] <= j) --l;  // axes were added in descending order
      with_count(count_ - l, [&](auto count) KTE_INLINE_LAMBDA { sum_row(sums[j], j, l, count); });
    }
    known_ = first_, count_ = 0;
  }

 private:
  /// Calls f with n as a type, so that its loops are unrolled.
  template <int N = most, class F>
  KTE_INLINE static void with_count(int n, const F& f) {
    if (n == N)
      f(std::integral_constant<int, N>{});
    else if constexpr (N > 0)
      with_count<N - 1>(n, f);
  }
  template <class Count>
  KTE_INLINE void sum_row(S* to, int j, int l, const Count& count) const {
    const S* const e = left_[l];
    const std::size_t row = left_.stride();
    std::array<S, most> rate;
    for (std::size_t n = 0; n < static_cast<std::size_t>(count()); ++n)
      rate[n] = factor_[static_cast<std::size_t>(l) + n] * e[n * row + static_cast<std::size_t>(j)];
    const bool is_new = j < known_;
    for_each_simd_to<S>(last_, j, [&](int k) KTE_INLINE_LAMBDA {
      simd<S> sum{}, e_k;
      if (!is_new) load<S>(sum, to + k);
      for (std::size_t n = 0; n < static_cast<std::size_t>(count()); ++n) {
        load<S>(e_k, e + n * row + k);
        sum += rate[n] * e_k;
      }
      store<S>(sum, to + k);
    });
  }
  axis_rows<S> left_;
  std::array<S, most> factor_{};
  std::array<int, most> axis_{};
  int count_ = 0, first_ = 0, known_ = 0, last_ = 0;
};

/// Working memory of M and its inverse.
template <class S>
struct mass_memory {
  wrench_rows<S> wrenches;  ///< by axis
  axis_rows<S> rows;
  collected_rows<S> left;  ///< e_lk
};

/// The inverse of the mass matrix from articulated inertias. A unit force on axis k leaves e_lk on axis l of its body
/// and of all bodies before it. With W the load that passes inward, initially zero,
///
///   e_kk = 1,   e_lk = s_l . W,   W -= gain_l e_lk          (2)
///   M^-1 = E^T D^-1 E                                       (3)
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
      w.change(r.first, r.last, [&](simd_wrench<S>& load, int k) KTE_INLINE_LAMBDA {  // (2)
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
