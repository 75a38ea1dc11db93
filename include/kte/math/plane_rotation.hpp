#pragma once

#include <kte/math/matrix.hpp>

/// R A R^T where R is known by its type to turn about x, y or z, as most joints do.
///
/// In the plane that turns, with cosine c and sine s,
///
///   w = s (a_xx - a_yy) + c (a_xy + a_yx)                                                (1)
///   a'_xx = a_xx - s w,   a'_yy = a_yy + s w,   a'_xy = c w - a_yx,   a'_yx = c w - a_xy    (2)
///
/// by c^2 + s^2 = 1: half the operations of two products of matrices.
namespace kte::detail {

/// The axis of such a rotation, 0, 1, 2 for x, y, z; otherwise -1.
template <class R>
inline constexpr int turned_axis = -1;
template <variable C, variable D, variable S, variable E>
inline constexpr int turned_axis<mat3<vec3<one_t, zero_t, zero_t>, vec3<zero_t, C, S>, vec3<zero_t, E, D>>> = 0;
template <variable C, variable D, variable S, variable E>
inline constexpr int turned_axis<mat3<vec3<C, zero_t, S>, vec3<zero_t, one_t, zero_t>, vec3<E, zero_t, D>>> = 1;
template <variable C, variable D, variable S, variable E>
inline constexpr int turned_axis<mat3<vec3<C, S, zero_t>, vec3<E, D, zero_t>, vec3<zero_t, zero_t, one_t>>> = 2;
template <class R>
concept turns_about_coordinate_axis = (turned_axis<R> >= 0);

/// Axes exchanged in turn, x for y, y for z, z for x, `times` times.
template <int Times, class... T>
KTE_INLINE constexpr auto cycled(const sym3<T...>& a) {
  if constexpr (Times == 0) {
    return a;
  } else {
    return cycled<Times - 1>(sym3{a.yy, a.yz, a.xy, a.zz, a.xz, a.xx});
  }
}
template <int Times, class X, class Y, class Z>
KTE_INLINE constexpr auto cycled(const mat3<X, Y, Z>& a) {
  if constexpr (Times == 0) {
    return a;
  } else {
    return cycled<Times - 1>(mat3{vec3{a.y.y, a.y.z, a.y.x}, vec3{a.z.y, a.z.z, a.z.x}, vec3{a.x.y, a.x.z, a.x.x}});
  }
}

template <class C, class S, class... T>
KTE_INLINE constexpr auto turned_about_z(const C& c, const S& s, const sym3<T...>& a) {
  const auto w = s * (a.xx - a.yy) + c * (a.xy + a.xy);
  return sym3{a.xx - s * w, c * w - a.xy, c * a.xz - s * a.yz, a.yy + s * w, s * a.xz + c * a.yz, a.zz};
}
template <class C, class S, class X, class Y, class Z>
KTE_INLINE constexpr auto turned_about_z(const C& c, const S& s, const mat3<X, Y, Z>& a) {
  const auto w = s * (a.x.x - a.y.y) + c * (a.x.y + a.y.x);
  return mat3{vec3{a.x.x - s * w, c * w - a.y.x, c * a.x.z - s * a.y.z},
              vec3{c * w - a.x.y, a.y.y + s * w, s * a.x.z + c * a.y.z},
              vec3{c * a.z.x - s * a.z.y, s * a.z.x + c * a.z.y, a.z.z}};
}
template <turns_about_coordinate_axis R, class A>
KTE_INLINE constexpr auto plane_congruence(const R& r, const A& a) {
  constexpr int to_z = (turned_axis<R> + 1) % 3;
  const auto in_z = cycled<to_z>(r);
  return cycled<(3 - to_z) % 3>(turned_about_z(in_z.x.x, in_z.y.x, cycled<to_z>(a)));
}

}  // namespace kte::detail

namespace kte {

/// R A R^T for a rotation R and a symmetric or any matrix A.
template <class R, class A>
KTE_INLINE constexpr auto turned_by(const R& r, const A& a) {
  if constexpr (detail::turns_about_coordinate_axis<R>) {
    return detail::plane_congruence(r, a);
  } else if constexpr (requires { congruence(r, a); }) {
    return congruence(r, a);
  } else {
    return transpose(r * transpose(r * a));
  }
}

}  // namespace kte
