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

/// Three numbers and a zero in one register. Typed constants times such a vector are those of math/constant.hpp.
template <class S>
struct register_vector {
  simd<S> n;
  KTE_INLINE friend register_vector operator+(const register_vector& a, const register_vector& b) {
    return {a.n + b.n};
  }
  KTE_INLINE friend register_vector operator-(const register_vector& a, const register_vector& b) {
    return {a.n - b.n};
  }
  KTE_INLINE friend register_vector operator*(const S& x, const register_vector& v) { return {x * v.n}; }
};
template <class S>
using direction = std::conditional_t<fits_register<S>, register_vector<S>, vec3<S>>;

/// A vector as a `direction`; entries and vectors that are typed zeros become numbers.
template <class S, class V>
KTE_INLINE direction<S> direction_of(const V& v) {
  if constexpr (typed_constant<V>)
    return direction<S>{};
  else if constexpr (std::is_same_v<V, direction<S>>)
    return v;
  else if constexpr (fits_register<S>)
    return {simd<S>{as<S>(v.x), as<S>(v.y), as<S>(v.z), S(0)}};
  else
    return as<S>(v);
}
template <class S>
KTE_INLINE vec3<S> components(const direction<S>& v) {
  if constexpr (fits_register<S>)
    return {v.n[0], v.n[1], v.n[2]};
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

/// v in the axes whose unit vectors are the rows of a matrix.
template <class Row, class X, class Y, class Z>
KTE_INLINE auto combined(const mat3<Row>& units, const vec3<X, Y, Z>& v) {
  return v.x * units.x + v.y * units.y + v.z * units.z;
}
/// The rotation from axes whose unit vectors are the rows of a matrix, for recursions/jacobian.hpp.
template <class Row>
struct rotation_of_units {
  const mat3<Row>& units;
};
template <class Row, class X, class Y, class Z>
KTE_INLINE auto combined(const rotation_of_units<Row>& r, const vec3<X, Y, Z>& v) {
  return combined(r.units, v);
}
#if defined(KTE_HAS_SHUFFLES)
/// v + a x b in registers. A typed zero stands for a vector.
template <class S>
KTE_INLINE register_vector<S> plus_cross(zero_t, const register_vector<S>& a, const register_vector<S>& b) {
  const simd<S> c =
      a.n * __builtin_shufflevector(b.n, b.n, 1, 2, 0, 3) - __builtin_shufflevector(a.n, a.n, 1, 2, 0, 3) * b.n;
  return {__builtin_shufflevector(c, c, 1, 2, 0, 3)};
}
template <class S>
KTE_INLINE register_vector<S> plus_cross(const register_vector<S>& v, const register_vector<S>& a,
                                         const register_vector<S>& b) {
  return v + plus_cross(zero, a, b);
}
template <class S>
KTE_INLINE register_vector<S> plus_cross(const register_vector<S>& v, zero_t, const register_vector<S>&) {
  return v;
}
#endif
/// Writes v and w as six numbers; adds them if several joints move by one coordinate and share a column.
template <bool Add, class S>
KTE_INLINE void put_column(S* to, const direction<S>& v, const direction<S>& w) {
#if defined(KTE_HAS_SHUFFLES)
  if constexpr (fits_register<S>) {
    typedef S two __attribute__((vector_size(2 * sizeof(S))));
    simd<S> first = __builtin_shufflevector(v.n, w.n, 0, 1, 2, 4);
    two rest = __builtin_shufflevector(w.n, w.n, 1, 2);
    if constexpr (Add) {
      simd<S> there;
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
