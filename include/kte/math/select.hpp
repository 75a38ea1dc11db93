#pragma once

#include <kte/detail/inline.hpp>

namespace kte {

/// a where the condition holds, else b. Kernels write this instead of a branch, so that they also work on packs, where
/// it holds for some states and not for others: pack scalars bring an overload of their own.
template <class T>
KTE_INLINE constexpr T select(bool condition, const T& a, const T& b) {
  return condition ? a : b;
}

/// Whether a condition holds, in a pack for all states.
KTE_INLINE constexpr bool all(bool condition) { return condition; }

}  // namespace kte
