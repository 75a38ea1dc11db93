#pragma once

#include <kte/kernels/joint_vector.hpp>
#include <kte/tree/simd.hpp>

#include <iterator>
#include <limits>

/// Whether contiguous numbers are finite, by registers; g++ makes more shuffles than sums of a scalar loop.
namespace kte::tree {

/// A pointer to the numbers of x if they are contiguous numbers S, otherwise nullptr.
template <class S, class X>
KTE_INLINE constexpr auto row_of(const X& x) {
  if constexpr (std::is_convertible_v<const X&, const S*>)
    return static_cast<const S*>(x);
  else if constexpr (requires {
                       requires bool(X::IsVectorAtCompileTime) && X::InnerStrideAtCompileTime == 1;
                     })  // Eigen's
    return x.data();
  else if constexpr (requires { requires std::contiguous_iterator<decltype(x.begin())>; })
    return x.data();
  else
    return nullptr;
}
template <class X, class S>
concept stands_in_row = std::is_same_v<decltype(row_of<S>(std::declval<const X&>())), const S*>;

/// Sums `factor` times the numbers; zero times the sum is zero unless a product (or the sum) is infinite or NaN.
/// Numbers that do not fill two registers are read twice.
template <class S>
KTE_INLINE bool all_finite_times(const S& factor, const S* x, std::size_t n) {
  constexpr std::size_t count = simd_of<S>::count;
  if constexpr (count > 1) {
    if (n >= count) {
      simd<S> some{}, others{};
      const auto add = [&factor](simd<S>& sum, const S* from) KTE_INLINE_LAMBDA {
        simd<S> y;
        load<S>(y, from);
        sum += y * factor;
      };
      for (std::size_t i = 0; i + 2 * count < n; i += 2 * count) add(some, x + i), add(others, x + i + count);
      add(some, x + (n < 2 * count ? 0 : n - 2 * count)), add(others, x + n - count);
      some += others;
      S sum(0);
      for (std::size_t k = 0; k < count; ++k) sum += some[k];
      return sum * S(0) == S(0);
    }
  }
  const S sum = detail::sum_by_four<S>(n, [&](std::size_t i) KTE_INLINE_LAMBDA { return S(x[i] * factor); });
  return all(sum * S(0) == S(0));
}
template <class S>
KTE_INLINE bool all_finite_in_row(const S* x, std::size_t n) {
  return all_finite_times(S(0), x, n);
}
/// Whether all numbers are finite and far from overflow: below 2^128 in double. May return false for a few numbers that
/// are nearly as large.
template <class S>
KTE_INLINE bool all_moderate_in_row(const S* x, std::size_t n) {
  using limits = std::numeric_limits<S>;
  constexpr S factor = [] {
    S product(1);
    for (int i = 0; i < limits::max_exponent / 8 * 7; ++i) product *= S(2);
    return product;
  }();
  return all_finite_times(factor, x, n);
}

}  // namespace kte::tree
