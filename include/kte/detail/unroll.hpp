#pragma once

#include <kte/detail/inline.hpp>

#include <type_traits>
#include <utility>

namespace kte::detail {

/// Calls f<I>() for each number I of a sequence, in order.
template <class N, N... I, class F>
KTE_INLINE constexpr void unroll(std::integer_sequence<N, I...>, [[maybe_unused]] const F& f) {
  // An array, because compilers limit the depth of fold expressions.
  const int done[]{(f.template operator()<I>(), 0)..., 0};
  (void)done;
}
/// Calls f<0>(), f<1>(), ..., f<N - 1>(); the numbers have the type of N.
template <auto N, class F>
KTE_INLINE constexpr void unroll(const F& f) {
  unroll(std::make_integer_sequence<std::remove_const_t<decltype(N)>, N>{}, f);
}

}  // namespace kte::detail
