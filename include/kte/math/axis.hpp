#pragma once

#include <kte/math/rotation_2D.hpp>

/// Axes of joints. `axis::x`, `axis::y`, `axis::z` are typed: a joint about one of them costs a plane rotation. Any
/// other axis is a unit vector of numbers.
namespace kte {

namespace axis {
/// Unit vectors along the coordinate axes: typed, exact, without cost.
inline constexpr vec3<one_t, zero_t, zero_t> x{};
inline constexpr vec3<zero_t, one_t, zero_t> y{};
inline constexpr vec3<zero_t, zero_t, one_t> z{};
inline constexpr vec3<constant<-1>, zero_t, zero_t> minus_x{};
inline constexpr vec3<zero_t, constant<-1>, zero_t> minus_y{};
inline constexpr vec3<zero_t, zero_t, constant<-1>> minus_z{};
}  // namespace axis

/// The rotation about the unit axis u by the angle with cosine c and sine s (Rodrigues):
///
///   R = c 1 + s [u]x + (1 - c) u u^T            (1)
///
/// With typed entries of u, for instance a coordinate axis, (1) folds to a plane rotation.
template <class X, class Y, class Z, class C, class S>
[[nodiscard]] KTE_INLINE constexpr auto rotation_about(const vec3<X, Y, Z>& u, const C& c, const S& s) {
  constexpr bool coordinate_axis =
      int{!std::is_same_v<X, zero_t>} + int{!std::is_same_v<Y, zero_t>} + int{!std::is_same_v<Z, zero_t>} == 1 &&
      typed_constant<X> && typed_constant<Y> && typed_constant<Z>;
  if constexpr (coordinate_axis) {  // u u^T is a diagonal of zeros and one 1; there c + (1 - c) is 1 exactly
    const auto d = [&](auto a) {
      if constexpr (std::is_same_v<decltype(a), zero_t>) {
        return c;
      } else {
        return one;
      }
    };
    return mat3{vec3{d(u.x), -(u.z * s), u.y * s}, vec3{u.z * s, d(u.y), -(u.x * s)},
                vec3{-(u.y * s), u.x * s, d(u.z)}};
  } else {
    const auto k = one - c;
    const auto t = k * u;
    return mat3{vec3{t.x * u.x + c, t.x * u.y - u.z * s, t.x * u.z + u.y * s},
                vec3{t.x * u.y + u.z * s, t.y * u.y + c, t.y * u.z - u.x * s},
                vec3{t.x * u.z - u.y * s, t.y * u.z + u.x * s, t.z * u.z + c}};
  }
}
/// The rotation about the unit axis u by `angle`, rad.
template <class X, class Y, class Z, variable T>
[[nodiscard]] constexpr auto rotation_about(const vec3<X, Y, Z>& u, const T& angle) {
  const auto r = rotation_by(angle);
  return rotation_about(u, r.cos, r.sin);
}

/// Rotations by 90 and 180 degrees: exact, typed, without cost. They compose by `*`.
inline constexpr mat3 quarter_turn_x{axis::x, vec3{zero, zero, minus_one}, vec3{zero, one, zero}};
inline constexpr mat3 quarter_turn_y{vec3{zero, zero, one}, axis::y, vec3{minus_one, zero, zero}};
inline constexpr mat3 quarter_turn_z{vec3{zero, minus_one, zero}, vec3{one, zero, zero}, axis::z};
inline constexpr auto minus_quarter_turn_x = transpose(quarter_turn_x);
inline constexpr auto minus_quarter_turn_y = transpose(quarter_turn_y);
inline constexpr auto minus_quarter_turn_z = transpose(quarter_turn_z);
inline constexpr auto half_turn_x = quarter_turn_x * quarter_turn_x;
inline constexpr auto half_turn_y = quarter_turn_y * quarter_turn_y;
inline constexpr auto half_turn_z = quarter_turn_z * quarter_turn_z;
/// Rotations by 90 and 180 degrees in the plane.
inline constexpr rotation_2D quarter_turn{zero, one};
inline constexpr rotation_2D half_turn{minus_one, zero};
inline constexpr rotation_2D minus_quarter_turn{zero, minus_one};

}  // namespace kte
