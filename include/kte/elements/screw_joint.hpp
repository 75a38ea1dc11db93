#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A screw joint: the end turns about an axis n by the coordinate q, rad, and advances along it by the pitch h, m/rad:
///
///   R = Rot(n, q),  p = h q n,  v = h q_dot n,  w = q_dot n,  a = h q_ddot n,  al = q_ddot n          (1)
template <class Axis, class Pitch>
struct screw_joint : transmission<screw_joint<Axis, Pitch>> {
  static constexpr type_name type{"screw_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  Axis axis;
  Pitch pitch;  // m/rad

  screw_joint() = default;
  constexpr screw_joint(const Axis& n, const Pitch& h) : axis(n), pitch(h) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& c) const {
    return motion{axis * (pitch * c.q), rotation_about(axis, c.cos, c.sin), axis * (pitch * c.q_dot),
                  axis * c.q_dot,       axis * (pitch * c.q_ddot),          axis * c.q_ddot};  // (1)
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(axis, "axis must have length 1");
    where.finite(pitch, "pitch must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
    visit("pitch", self.pitch);
  }
};

}  // namespace core

/// A screw joint about a unit axis, which is constant in base and end axes. `pitch`, m/rad: L/(2 pi) for a thread with
/// a lead of L, m per turn; negative for left-handed threads.
template <class Q, class B, class E, class X, class Y, class Z, entry Pitch>
[[nodiscard]] constexpr auto screw_joint_3D(const Q& coordinate, const B& base, const E& end, const vec3<X, Y, Z>& axis,
                                            const Pitch& pitch) {
  const auto h = real(pitch);
  return connect(core::screw_joint<vec3<X, Y, Z>, std::remove_const_t<decltype(h)>>(axis, h), coordinate, base, end);
}

KTE_CALL(screw_joint_3D, "(coordinate, base, end, axis, pitch); an axis is a vector, such as kte::axis::x")

}  // namespace kte
