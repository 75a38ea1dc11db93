#pragma once

#include <kte/contract/port.hpp>
#include <kte/math/rotation_2D.hpp>
#include <kte/math/select.hpp>

#include <cmath>

/// The rotation between two frames.
namespace kte {

namespace detail {

/// The rotation vector (axis times angle) of a rotation matrix, with the angle in [0, pi], without branches, and
/// without NaN for the identity, also in derivatives. With the quaternion q = (w, u) of R, 4 q q^T consists of sums of
/// entries of R. Its row with the largest diagonal entry is a multiple of q with all digits (Shepperd, J. Guidance and
/// Control 1, 1978), and the factor cancels in
///
///   r = 2 atan2(|u|, w)/|u| u,  for u = 0  2/w u                    (1)
template <class RX, class RY, class RZ>
KTE_INLINE constexpr auto turn_of(const mat3<RX, RY, RZ>& rotation) {
  using std::atan2;
  using std::sqrt;
  using S =
      decltype(as_number(dot(rotation.x, rotation.x) + dot(rotation.y, rotation.y) + dot(rotation.z, rotation.z)));
  const auto m = as<S>(rotation);
  const S a = m.x.x, b = m.y.y, c = m.z.z;
  const S wx = m.z.y - m.y.z, wy = m.x.z - m.z.x, wz = m.y.x - m.x.y;
  const S xy = m.x.y + m.y.x, yz = m.y.z + m.z.y, zx = m.z.x + m.x.z;
  const S ww = S(1) + a + b + c, xx = S(1) + a - b - c, yy = S(1) + b - c - a, zz = S(1) + c - a - b;
  struct row {
    S diagonal, w;
    vec3<S> u;
  };
  const auto larger = [](const row& p, const row& other) KTE_INLINE_LAMBDA {
    const auto second = other.diagonal > p.diagonal;
    const auto of = [&second](const S& x, const S& y) KTE_INLINE_LAMBDA { return S(select(second, y, x)); };
    return row{of(p.diagonal, other.diagonal),
               of(p.w, other.w),
               {of(p.u.x, other.u.x), of(p.u.y, other.u.y), of(p.u.z, other.u.z)}};
  };
  const row largest = larger(larger(row{ww, ww, {wx, wy, wz}}, row{xx, wx, {xx, xy, zx}}),
                             larger(row{yy, wy, {xy, yy, yz}}, row{zz, wz, {zx, yz, zz}}));
  const S sign = select(largest.w < S(0), S(-1), S(1));  // selects the quaternion with w >= 0
  const S w = sign * largest.w, square = dot(largest.u, largest.u);
  const auto none = square == S(0);
  const S n = sqrt(select(none, S(1), square));
  const S k = S(2) * sign * select(none, S(1), S(atan2(n, w))) / select(none, w, n);  // (1)
  return vec3<S>{k * largest.u.x, k * largest.u.y, k * largest.u.z};
}

/// The rotation about z: an angle in [-pi, pi].
template <class C, class S>
KTE_INLINE constexpr auto turn_of(const rotation_2D<C, S>& r) {
  using std::atan2;
  using T = decltype(as_number(r.cos * r.cos + r.sin * r.sin));
  return vec3{zero, zero, T(atan2(as<T>(r.sin), as<T>(r.cos)))};
}

/// R_1^T R_2 of two rotations, in the plane about z.
template <kind Dim, class A, class B>
KTE_INLINE constexpr auto relative_rotation(const A& a, const B& b) {
  if constexpr (Dim == kind::frame_3D) {
    return transpose(matrix(a)) * matrix(b);
  } else {
    return transpose(a) * b * rotation_2D{one, zero};
  }
}

}  // namespace detail

}  // namespace kte
