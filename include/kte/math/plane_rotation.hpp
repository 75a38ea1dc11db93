#pragma once

#include <kte/math/matrix.hpp>

/// R A R^T for a rotation R whose type says that it is about x, y or z, as for most joints, possibly combined with
/// quarter turns.
///
/// In the plane of rotation, with cosine c and sine s,
///
///   w = s (a_xx - a_yy) + c (a_xy + a_yx)                                                (1)
///   a'_xx = a_xx - s w,   a'_yy = a_yy + s w,   a'_xy = c w - a_yx,   a'_yx = c w - a_xy    (2)
///
/// by c^2 + s^2 = 1: half the operations of two products of matrices.
namespace kte::detail {

/// The position of an entry of the rotation that is known to be 1 or -1: e_row = sign R e_column. Column -1 if there is
/// none.
struct turned_plane {
  int row = -1, column = -1, sign = 0;
};
template <class T>
inline constexpr int entry_code = variable<T> ? 2 : 3;  // 0, 1, -1; 2: a number; 3: another constant
template <int N>
inline constexpr int entry_code<constant<N>> = N* N <= 1 ? N : 3;
template <class R>
inline constexpr turned_plane plane_of{};
template <class... A, class... B, class... C>
inline constexpr turned_plane plane_of<mat3<vec3<A...>, vec3<B...>, vec3<C...>>> = [] {
  const int code[3][3]{{entry_code<A>...}, {entry_code<B>...}, {entry_code<C>...}};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      bool fits = code[row][column] == 1 || code[row][column] == -1;
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          if (i != row || k != column) fits &= code[i][k] == (i == row || k == column ? 0 : 2);
      if (fits) return turned_plane{row, column, code[row][column]};
    }
  return turned_plane{};
}();
template <class R>
concept turns_in_a_plane = (plane_of<R>.column >= 0);

/// Cyclic exchange of axes, x for y, y for z, z for x, `times` times.
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

template <int Times, class X, class Y, class Z>
KTE_INLINE constexpr auto cycled_rows(const mat3<X, Y, Z>& a) {
  if constexpr (Times == 0) {
    return a;
  } else {
    return cycled_rows<Times - 1>(mat3{a.y, a.z, a.x});
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
/// Rotated by half a turn about x.
template <class... T>
KTE_INLINE constexpr auto half_turned(const sym3<T...>& a) {
  return sym3{a.xx, -a.xy, -a.xz, a.yy, a.yz, a.zz};
}
template <class X, class Y, class Z>
KTE_INLINE constexpr auto half_turned(const mat3<X, Y, Z>& a) {
  return mat3{vec3{a.x.x, -a.x.y, -a.x.z}, vec3{-a.y.x, a.y.y, a.y.z}, vec3{-a.z.x, a.z.y, a.z.z}};
}
/// With rows and columns exchanged cyclically such that the known entry is zz, R is a rotation about z; if the entry is
/// -1, after half a turn about x.
template <turns_in_a_plane R, class A>
KTE_INLINE constexpr auto plane_congruence(const R& r, const A& a) {
  constexpr turned_plane at = plane_of<R>;
  constexpr int columns = (at.column + 1) % 3, rows = (at.row + 1) % 3;
  const auto t = transpose(cycled_rows<columns>(transpose(cycled_rows<rows>(r))));
  if constexpr (at.sign > 0) {
    return cycled<(3 - rows) % 3>(turned_about_z(t.x.x, t.y.x, cycled<columns>(a)));
  } else {
    return cycled<(3 - rows) % 3>(turned_about_z(t.x.x, t.y.x, half_turned(cycled<columns>(a))));
  }
}

}  // namespace kte::detail

namespace kte {

/// R A R^T for a rotation R and a symmetric or any matrix A.
template <class R, class A>
[[nodiscard]] KTE_INLINE constexpr auto turned_by(const R& r, const A& a) {
  if constexpr (detail::turns_in_a_plane<R>) {
    return detail::plane_congruence(r, a);
  } else if constexpr (requires { congruence(r, a); }) {
    return congruence(r, a);
  } else {
    return transpose(r * transpose(r * a));
  }
}

}  // namespace kte
