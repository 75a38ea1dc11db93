#pragma once

#include <kte/detail/shuffles.hpp>
#include <kte/math/matrix.hpp>
#include <kte/tree/simd.hpp>

/// A vector in space whose components are not accessed: one register with the last of four numbers zero if four numbers
/// fit, otherwise three numbers.
namespace kte::tree {

#if defined(KTE_HAS_SHUFFLES)
template <class S>
inline constexpr bool fits_register = simd_of<S>::count == 4;
#else
template <class S>
inline constexpr bool fits_register = false;
#endif
template <class S>
using direction = std::conditional_t<fits_register<S>, simd<S>, vec3<S>>;

template <class S>
KTE_INLINE direction<S> direction_of(const vec3<S>& v) {
  if constexpr (fits_register<S>)
    return direction<S>{v.x, v.y, v.z, S(0)};
  else
    return v;
}
template <class S>
KTE_INLINE vec3<S> components(const direction<S>& v) {
  if constexpr (fits_register<S>)
    return {v[0], v[1], v[2]};
  else
    return v;
}
/// Rows of a matrix.
template <class S>
KTE_INLINE mat3<direction<S>> directions_of(const mat3<vec3<S>>& m) {
  return {direction_of<S>(m.x), direction_of<S>(m.y), direction_of<S>(m.z)};
}
template <class S>
KTE_INLINE mat3<vec3<S>> components(const mat3<direction<S>>& m) {
  return {components<S>(m.x), components<S>(m.y), components<S>(m.z)};
}

template <class S>
KTE_INLINE direction<S> crossed(const direction<S>& a, const direction<S>& b) {
#if defined(KTE_HAS_SHUFFLES)
  if constexpr (fits_register<S>) {
    const direction<S> c =
        a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;
    return __builtin_shufflevector(c, c, 1, 2, 0, 3);
  } else
#endif
  {
    return cross(a, b);
  }
}
/// Writes v and w as six numbers; adds them if several joints move by one coordinate and share a column.
template <bool Add, class S>
KTE_INLINE void put_column(S* to, const direction<S>& v, const direction<S>& w) {
#if defined(KTE_HAS_SHUFFLES)
  if constexpr (fits_register<S>) {
    typedef S two __attribute__((vector_size(2 * sizeof(S))));
    direction<S> first = __builtin_shufflevector(v, w, 0, 1, 2, 4);
    two rest = __builtin_shufflevector(w, w, 1, 2);
    if constexpr (Add) {
      direction<S> there;
      two there_too;
      load<S>(there, to), load<S>(there_too, to + 4);
      first += there, rest += there_too;
    }
    store<S>(first, to), store<S>(rest, to + 4);
  } else
#endif
  {
    const S all[]{v.x, v.y, v.z, w.x, w.y, w.z};
    for (int i = 0; i < 6; ++i) to[i] = Add ? S(to[i] + all[i]) : all[i];
  }
}

}  // namespace kte::tree
