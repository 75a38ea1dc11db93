#pragma once

#include <kte/math/constant.hpp>

#include <type_traits>

/// Values that recursions pass from body to body: vectors, inertias, and structs of them, whose entries may be typed
/// constants. Such a type is a template `T<fields...>` that is `geometric`.
namespace kte::engine {

/// The type with numbers S instead of typed constants, for arrays. `skip` remains.
template <class S, class T>
struct dense_of {
  using type = S;
};
template <class S>
struct dense_of<S, skip> {
  using type = skip;
};
template <class S, template <class...> class T, class... F>
requires geometric<T<F...>>
struct dense_of<S, T<F...>> {
  using type = T<typename dense_of<S, F>::type...>;
};
template <class S, class T>
using dense = typename dense_of<S, std::remove_cvref_t<T>>::type;

template <class T>
inline constexpr int fields = 0;
template <template <class...> class T, class... F>
requires geometric<T<F...>>
inline constexpr int fields<T<F...>> = sizeof...(F);

/// Calls f(fields of x ...).
template <class T, class F>
KTE_INLINE constexpr decltype(auto) with_fields(T& x, const F& f) {
  constexpr int n = fields<std::remove_const_t<T>>;
  static_assert(n >= 2 && n <= 6);
  if constexpr (n == 2) {
    auto& [a, b] = x;
    return f(a, b);
  } else if constexpr (n == 3) {
    auto& [a, b, c] = x;
    return f(a, b, c);
  } else if constexpr (n == 4) {
    auto& [a, b, c, d] = x;
    return f(a, b, c, d);
  } else if constexpr (n == 5) {
    auto& [a, b, c, d, e] = x;
    return f(a, b, c, d, e);
  } else {
    auto& [a, b, c, d, e, g] = x;
    return f(a, b, c, d, e, g);
  }
}
/// A copy number by number. For a copy of the whole struct g++ 12 keeps both sides in memory.
template <class T>
KTE_INLINE constexpr T fresh(const T& x) {
  if constexpr (fields<T> == 0) {
    return x;
  } else {
    return with_fields(x, [](const auto&... f) KTE_INLINE_LAMBDA { return T{fresh(f)...}; });
  }
}
/// to = from, number by number; typed constants become numbers. Typed constants of `to`, and entries that either side
/// skips, are unchanged.
template <class T, class U>
KTE_INLINE constexpr void assign(T& to, const U& from) {
  if constexpr (std::is_same_v<T, skip> || std::is_same_v<U, skip> || typed_constant<T>) {
    return;
  } else if constexpr (fields<T> == 0) {
    to = as<T>(from);
  } else {
    with_fields(to, [&from](auto&... t) KTE_INLINE_LAMBDA {
      with_fields(from, [&t...](const auto&... f) KTE_INLINE_LAMBDA {
        const int done[]{(assign(t, f), 0)...};
        (void)done;
      });
    });
  }
}

/// Stored numbers as a type T, which has typed constants for some of them.
template <class T>
struct typed_as {
  template <class U>
  KTE_INLINE static constexpr T of(const U& x) {
    if constexpr (typed_constant<T> || std::is_same_v<T, skip>) {
      return {};
    } else {
      return x;
    }
  }
};
template <template <class...> class T, class... F>
requires geometric<T<F...>>
struct typed_as<T<F...>> {
  template <class U>
  KTE_INLINE static constexpr T<F...> of(const U& x) {
    if constexpr (std::is_same_v<U, skip>) {
      return {};
    } else {
      return with_fields(x, [](const auto&... f) KTE_INLINE_LAMBDA { return T<F...>{typed_as<F>::of(f)...}; });
    }
  }
};

}  // namespace kte::engine
