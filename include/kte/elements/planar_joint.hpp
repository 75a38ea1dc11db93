#pragma once

#include <kte/contract/transmission.hpp>

namespace kte {

namespace core {

/// A planar joint: the end slides in the plane x, y of the base and turns about z, by a coordinate X that is a pose in
/// that plane:
///
///   p = p_X,  R = Rot(z, angle_X),  v = v_X,  w = w_X z,  a = a_X + w x v,  al = al_X z          (1)
///
/// a_X is the rate of the components of v.
struct planar_joint : transmission<planar_joint> {
  static constexpr type_name type{"planar_joint", kind::frame_3D};
  static constexpr std::array<port, 3> ports{{{kind::pose_2D, access::angle, "coordinate"},
                                              {kind::frame_3D, access::in, "base"},
                                              {kind::frame_3D, access::out, "end"}}};

  template <class X>
  KTE_INLINE constexpr auto relative(const X& c) const {
    return motion{c.position,
                  matrix(c.rotation),
                  c.velocity,
                  c.ang_velocity,
                  c.acceleration + cross(c.ang_velocity, c.velocity),
                  c.ang_acceleration};  // (1)
  }
  constexpr void check(const parameter_check&) const {}
  template <class Self, class Visit>
  static constexpr void parameters(Self&, Visit&&) {}
};

}  // namespace core

/// A body that slides on a plane in space, which is x, y of the base: `coordinate`, a pose_2D_key, is the pose of `end`
/// in it. Other planes: `.at(position, rotation)`.
template <class X, class B, class E>
[[nodiscard]] constexpr auto planar_joint_3D(const X& coordinate, const B& base, const E& end) {
  return connect(core::planar_joint{}, coordinate, base, end);
}

KTE_CALL(planar_joint_3D, "(coordinate, base, end)")

}  // namespace kte
