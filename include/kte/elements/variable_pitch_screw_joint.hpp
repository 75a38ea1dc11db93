#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A screw joint whose pitch changes with its angle: the end turns about an axis n by the coordinate q, rad, and
/// advances along it by d:
///
///   R = Rot(n, q),  p = d n,  d = h q + k q^2 / 2,  d' = h + k q                              (1)
///   v = d' q_dot n,  w = q_dot n,  a = (d' q_ddot + k q_dot^2) n,  al = q_ddot n              (2)
template <class Axis, class Pitch, class Change>
struct variable_pitch_screw_joint : transmission<variable_pitch_screw_joint<Axis, Pitch, Change>> {
  static constexpr type_name type{"variable_pitch_screw_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::gen, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};
  static constexpr bool varying_axes = true;

  Axis axis;
  Pitch pitch;          // h, m/rad
  Change pitch_change;  // k, m/rad^2

  variable_pitch_screw_joint() = default;
  constexpr variable_pitch_screw_joint(const Axis& n, const Pitch& h, const Change& k)
      : axis(n), pitch(h), pitch_change(k) {}

  template <class C>
  KTE_INLINE constexpr auto relative(const C& c) const {
    const auto now = pitch + pitch_change * c.q;
    return motion{axis * (detail::half(pitch + now) * c.q),
                  rotation_about(axis, c.cos, c.sin),
                  axis * (now * c.q_dot),
                  axis * c.q_dot,
                  axis * (now * c.q_ddot + pitch_change * (c.q_dot * c.q_dot)),
                  axis * c.q_ddot};  // (1), (2)
  }
  constexpr void check(const parameter_check& where) const {
    where.unit(axis, "axis must have length 1");
    where.finite(pitch, "pitch must be finite");
    where.finite(pitch_change, "pitch_change must be finite");
  }
  template <class Self, class Visit>
  static constexpr void parameters(Self& self, Visit&& visit) {
    visit("axis", self.axis);
    visit("pitch", self.pitch);
    visit("pitch_change", self.pitch_change);
  }
};

}  // namespace core

/// A screw joint about a unit axis, whose pitch at the angle q is `pitch` + `pitch_change` q, in m/rad. For any other
/// pitch define a joint: docs/adding_an_element.md.
template <class Q, class B, class E, class X, class Y, class Z, entry Pitch, entry Change>
[[nodiscard]] constexpr auto variable_pitch_screw_joint_3D(const Q& coordinate, const B& base, const E& end,
                                                           const vec3<X, Y, Z>& axis, const Pitch& pitch,
                                                           const Change& pitch_change) {
  const auto h = real(pitch), k = real(pitch_change);
  return connect(core::variable_pitch_screw_joint<vec3<X, Y, Z>, std::remove_const_t<decltype(h)>,
                                                  std::remove_const_t<decltype(k)>>(axis, h, k),
                 coordinate, base, end);
}

KTE_CALL(variable_pitch_screw_joint_3D,
         "(coordinate, base, end, axis, pitch, pitch_change); an axis is a vector, such as kte::axis::x")

}  // namespace kte
