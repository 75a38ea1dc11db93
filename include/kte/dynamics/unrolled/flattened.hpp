#pragma once

#include <kte/detail/inline.hpp>
#include <kte/math/plain_scalar.hpp>

namespace kte::detail {

/// f(), with all calls in it inlined. Otherwise g++ keeps the copies of vectors and inertias of packs as calls, which
/// pass packs through memory (docs/decisions/07-packs.md).
template <class F>
#if (defined(__GNUC__) || defined(__clang__)) && !defined(KTE_NO_FORCED_INLINE)
[[gnu::flatten]]
#endif
auto flattened(const F& f) {
  return f();
}
/// f(), `flattened` if S is a pack and the chain is unrolled.
template <class S, bool IsUnrolled, class F>
KTE_INLINE auto in_one_function(const F& f) {
  if constexpr (is_pack<S> && IsUnrolled) {
    return flattened(f);
  } else {
    return f();
  }
}

}  // namespace kte::detail
