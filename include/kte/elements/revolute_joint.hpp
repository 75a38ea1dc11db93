#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A revolute joint: the end turns about an axis n by the coordinate q, rad:
///
///   R = Rot(n, q),  p = 0,  w = n q_dot,  al = n q_ddot          (1)
template <kind Dim, class Axis>
struct revolute_joint : transmission<revolute_joint<Dim, Axis>> {
  static constexpr type_name type{"revolute_joint", Dim};
  static constexpr std::array<port, 3> ports{
      {{kind::gen, access::angle, "coordinate"}, {Dim, access::in, "base"}, {Dim, access::out, "end"}}};

  Axis axis;

  revolute_joint() = default;
  constexpr explicit revolute_joint(const Axis& n) : axis(n) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& c) const {
    return motion{zero3{}, rotation(c), zero3{}, axis * c.q_dot, zero3{}, axis * c.q_ddot};  // (1)
  }
  constexpr void check(const parameter_check& where) const { where.unit(axis, "axis must have length 1"); }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
  }

 private:
  template <class C>
  KTE_INLINE constexpr auto rotation(const C& c) const {
    if constexpr (Dim == kind::frame_2D) {
      return rotation_2D{c.cos, c.sin};
    } else {
      return rotation_about(axis, c.cos, c.sin);
    }
  }
};

}  // namespace core

/// A revolute joint in the plane. `coordinate`: angle from base to end, rad.
template <class Q, class B, class E>
[[nodiscard]] constexpr auto revolute_joint_2D(const Q& coordinate, const B& base, const E& end) {
  return connect(core::revolute_joint<kind::frame_2D, std::remove_const_t<decltype(axis::z)>>(axis::z), coordinate,
                 base, end);
}

/// A revolute joint in space about a unit axis, which is constant in base and end axes. Any `vec3` of length 1 is
/// valid; the typed axes `axis::x`, `axis::y`, ... save arithmetic.
template <class Q, class B, class E, class X = zero_t, class Y = zero_t, class Z = one_t>
[[nodiscard]] constexpr auto revolute_joint_3D(const Q& coordinate, const B& base, const E& end,
                                               const vec3<X, Y, Z>& axis = {}) {
  return connect(core::revolute_joint<kind::frame_3D, vec3<X, Y, Z>>(axis), coordinate, base, end);
}

KTE_CALL(revolute_joint_2D, "(coordinate, base, end)")
KTE_CALL(revolute_joint_3D, "(coordinate, base, end[, axis]); an axis is a vector, such as kte::axis::x")

}  // namespace kte
