#pragma once

#include <kte/elements/joint_series.hpp>
#include <kte/elements/revolute_joint.hpp>

namespace kte {

namespace detail {
/// Rejects parallel axes, for which M would be singular.
template <class A1, class A2, class... Names>
constexpr void check_axes(std::string_view type, const A1& axis1, const A2& axis2, const Names&... names) {
  const auto n = cross(as<double>(axis1), as<double>(axis2));
  check_series(
      type,
      [&n](const parameter_check& where) {
        where.require(dot(n, n) > 1e-12, "axes must not be parallel: the squared sine between them must be above 1e-12",
                      dot(n, n));
      },
      names...);
}
}  // namespace detail

/// A universal (Cardan, Hooke) joint without offset: a cross turns in the base about axis 1 by q1, rad, and the end
/// turns in the cross about axis 2 by q2, rad. It consists of two revolute joints with the frame `inner_of(end)`, the
/// cross, between them.
///
///   R = Rot(n1, q1) Rot(n2, q2),  p = 0          (n1 in axes of the base, n2 in those of the end)
template <class Q1, class Q2, class B, class E, class X1, class Y1, class Z1, class X2, class Y2, class Z2>
[[nodiscard]] constexpr auto universal_joint_3D(const Q1& q1, const Q2& q2, const B& base, const E& end,
                                                const vec3<X1, Y1, Z1>& axis1, const vec3<X2, Y2, Z2>& axis2) {
  const auto inner = inner_of(end);
  const auto first = revolute_joint_3D(q1, base, inner, axis1);
  const auto both = detail::in_series(first, revolute_joint_3D(q2, inner, end, axis2));
  detail::check_axes("universal_joint_3D", axis1, axis2, q1, q2, base, end);
  return both;
}

/// A universal joint with an offset r, m, from axis 1 to axis 2, in axes of the cross:
///
///   R = Rot(n1, q1) Rot(n2, q2),  p = Rot(n1, q1) r
template <class Q1, class Q2, class B, class E, class X1, class Y1, class Z1, class X2, class Y2, class Z2, class X,
          class Y, class Z>
[[nodiscard]] constexpr auto hooke_joint_3D(const Q1& q1, const Q2& q2, const B& base, const E& end,
                                            const vec3<X1, Y1, Z1>& axis1, const vec3<X2, Y2, Z2>& axis2,
                                            const vec3<X, Y, Z>& offset) {
  const auto inner = inner_of(end);
  const auto first = revolute_joint_3D(q1, base, inner, axis1);
  const auto both = detail::in_series(first, revolute_joint_3D(q2, inner, end, axis2).at(offset));
  detail::check_axes("hooke_joint_3D", axis1, axis2, q1, q2, base, end);
  return both;
}

KTE_CALL(universal_joint_3D, "(q1, q2, base, end, axis1, axis2); an axis is a vector, such as kte::axis::x")
KTE_CALL(hooke_joint_3D, "(q1, q2, base, end, axis1, axis2, offset); an axis is a vector, such as kte::axis::x")

}  // namespace kte
