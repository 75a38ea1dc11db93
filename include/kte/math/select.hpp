#pragma once

#include <kte/detail/inline.hpp>

#include <type_traits>
#include <utility>

namespace kte {

/// a where the condition holds, else b. Kernels write this instead of a branch, so that they also work on packs, where
/// it holds for some states and not for others: pack scalars bring an overload of their own.
template <class T>
KTE_INLINE constexpr T select(bool condition, const T& a, const T& b) {
  return condition ? a : b;
}

/// Whether a condition holds, in a pack for all states, for any.
KTE_INLINE constexpr bool all(bool condition) { return condition; }
KTE_INLINE constexpr bool any(bool condition) { return condition; }

/// What a comparison of numbers gives: a bool, of packs a mask.
template <class S>
using truth = decltype(std::declval<const S&>() < std::declval<const S&>());

namespace detail {
/// a and b, of truths of either kind.
template <class Truth>
KTE_INLINE constexpr Truth both(const Truth& a, const Truth& b) {
  if constexpr (std::is_same_v<Truth, bool>)
    return a && b;
  else
    return a & b;
}
}  // namespace detail

}  // namespace kte
