#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A joint that slides along an axis n by the coordinate q, m:
///
///   R = 1,  p = n q,  v = n q_dot,  a = n q_ddot          (1)
template <kind Dim, class Axis>
struct prismatic_joint : transmission<prismatic_joint<Dim, Axis>> {
  static constexpr type_name type{"prismatic_joint", Dim};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::in, "coordinate"}, {Dim, access::in, "base"}, {Dim, access::out, "end"}}};

  Axis axis;

  prismatic_joint() = default;
  constexpr explicit prismatic_joint(const Axis& n) : axis(n) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& c) const {
    return motion{axis * c.q, no_rotation{}, axis * c.q_dot, zero3{}, axis * c.q_ddot, zero3{}};  // (1)
  }
  constexpr void check(const parameter_check& where) const { where.unit(axis, "axis must have length 1"); }

  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
  }
};

}  // namespace core

/// A prismatic joint in the plane along a unit axis in base axes: `axis::x`, `axis::y`, `vec2{0.6, 0.8}`.
template <class Q, class B, class E, geometric Axis>
[[nodiscard]] constexpr auto prismatic_joint_2D(const Q& coordinate, const B& base, const E& end, const Axis& axis) {
  const auto n = detail::planar(axis);
  return connect(core::prismatic_joint<kind::frame_2D, std::remove_const_t<decltype(n)>>(n), coordinate, base, end);
}

/// A prismatic joint in space along a unit axis in base axes.
template <class Q, class B, class E, class X, class Y, class Z>
[[nodiscard]] constexpr auto prismatic_joint_3D(const Q& coordinate, const B& base, const E& end,
                                                const vec3<X, Y, Z>& axis) {
  return connect(core::prismatic_joint<kind::frame_3D, vec3<X, Y, Z>>(axis), coordinate, base, end);
}

KTE_CALL(prismatic_joint_2D, "(coordinate, base, end, axis); an axis is a vector, such as kte::axis::x")
KTE_CALL(prismatic_joint_3D, "(coordinate, base, end, axis); an axis is a vector, such as kte::axis::x")

}  // namespace kte
