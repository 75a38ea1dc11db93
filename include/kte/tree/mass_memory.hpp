#pragma once

#include <kte/tree/bodies.hpp>
#include <kte/tree/columns.hpp>

#include <type_traits>

/// What the mass matrix and its inverse have in common.
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

}  // namespace kte::tree
