#pragma once

#include <kte/engine/body.hpp>
#include <kte/frames/articulated.hpp>

/// Joint axes that are unit vectors of the body by type: their rows and columns are omitted at compile time.
namespace kte::engine {

template <class T>
inline constexpr int constant_value = 2;  // of none
template <int N>
inline constexpr int constant_value<constant<N>> = N;
/// The number of a unit axis: 0, 1, 2 along x, y, z; 3, 4, 5 about them; -1: not a unit axis.
template <class A>
inline constexpr int unit_axis = -1;
template <class... V, class... W>
inline constexpr int unit_axis<motion_vector<vec3<V...>, vec3<W...>>> = [] {
  const int entries[]{constant_value<V>..., constant_value<W>...};
  int n = -1, others = 0;
  for (int i = 0; i < 6; ++i) {
    if (entries[i] == 1 || entries[i] == -1)
      n = n < 0 ? i : 6;
    else
      others += entries[i] * entries[i];
  }
  return others == 0 && n < 6 ? n : -1;
}();

/// f(s) of unit axis n, as a type.
template <class F>
KTE_INLINE constexpr auto with_unit_axis(int n, const F& f) {
  switch (n) {
    case 0:
      return f(motion_vector{vec3{one, zero, zero}, zero3{}});
    case 1:
      return f(motion_vector{vec3{zero, one, zero}, zero3{}});
    case 2:
      return f(motion_vector{vec3{zero, zero, one}, zero3{}});
    case 3:
      return f(motion_vector{zero3{}, vec3{one, zero, zero}});
    case 4:
      return f(motion_vector{zero3{}, vec3{zero, one, zero}});
    default:
      return f(motion_vector{zero3{}, vec3{zero, zero, one}});
  }
}
template <int N, int At, class X>
KTE_INLINE constexpr auto unless(const X& x) {
  if constexpr (N == At) {
    return zero;
  } else {
    return x;
  }
}
/// A vector without entry N, or a matrix without row and column N. Entries are counted from `From`.
template <int N, int From = 0, class X, class Y, class Z>
KTE_INLINE constexpr auto without(const vec3<X, Y, Z>& v) {
  return vec3{unless<N, From>(v.x), unless<N, From + 1>(v.y), unless<N, From + 2>(v.z)};
}
template <int N, int From = 0, class... T>
KTE_INLINE constexpr auto without(const sym3<T...>& m) {
  constexpr int n = N - From;
  return sym3{unless<n, 0>(m.xx), unless<n, 0>(unless<n, 1>(m.xy)), unless<n, 0>(unless<n, 2>(m.xz)),
              unless<n, 1>(m.yy), unless<n, 1>(unless<n, 2>(m.yz)), unless<n, 2>(m.zz)};
}
template <int N, class V, class W>
KTE_INLINE constexpr auto without(const motion_vector<V, W>& x) {
  return motion_vector{without<N>(x.linear), without<N, 3>(x.angular)};
}
template <int N, class V, class W>
KTE_INLINE constexpr auto without(const wrench<V, W>& x) {
  return wrench{without<N>(x.force), without<N, 3>(x.torque)};
}
template <int N, int Row, class V>
KTE_INLINE constexpr auto row_without(const V& v) {
  if constexpr (N == Row) {
    return zero3{};
  } else {
    return without<N, 3>(v);
  }
}
template <int N, class M, class H, class J>
KTE_INLINE constexpr auto without(const articulated<M, H, J>& x) {
  const auto& h = x.coupling;
  return articulated{without<N>(x.linear), mat3{row_without<N, 0>(h.x), row_without<N, 1>(h.y), row_without<N, 2>(h.z)},
                     without<N, 3>(x.angular)};
}

}  // namespace kte::engine
