#pragma once

#include <kte/detail/inline.hpp>

#include <type_traits>
#include <utility>

namespace kte {

/// a where the condition holds, else b. Kernels use it instead of a branch, so that they work on packs, where the
/// condition may hold for some elements only. Packs have an overload.
template <class T>
KTE_INLINE constexpr T select(bool condition, const T& a, const T& b) {
  return condition ? a : b;
}

/// Whether a condition holds; for a pack: in all elements.
KTE_INLINE constexpr bool all(bool condition) { return condition; }
/// Whether a condition holds; for a pack: in at least one element.
KTE_INLINE constexpr bool any(bool condition) { return condition; }

/// The type of a comparison of numbers: bool, or the mask of a pack.
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
